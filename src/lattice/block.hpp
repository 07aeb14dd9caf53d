#pragma once
#include <array>
#include <cstddef>

namespace hemomag::lattice {

/// The nodes one rank owns on a brick decomposition of the whole grid. Node i of a direction sits
/// at i + 1/2.
struct Block {
  std::array<int, 3> global{};  ///< nodes of the whole grid, x y z
  std::array<int, 3> begin{};   ///< global index of the first owned node
  std::array<int, 3> size{};    ///< owned nodes

  std::size_t owned() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
};

/// First node of part k when n nodes are shared by `parts` equal slabs: the nodes whose centres lie
/// at or above k n / parts, i.e. ceil(k n / parts - 1/2) in exact integer arithmetic.
constexpr int first_node(int n, int parts, int k) {
  const long numerator = 2L * k * n - parts, denominator = 2L * parts;
  return static_cast<int>(numerator <= 0 ? 0 : (numerator + denominator - 1) / denominator);
}

}  // namespace hemomag::lattice
