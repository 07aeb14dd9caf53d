#pragma once
#include <array>
#include <cstddef>

namespace hemomag::lattice {

/// How one scalar of every node of a block lies in memory: [z][y][x], x fastest, with `halo` ghost
/// nodes on every side. Every row starts on a 64-byte line and is padded to whole lines, so that a
/// row is swept in full vectors without a remainder; what lies in the padding is never read by a
/// real node.
///
///     | left halo | x = 0 ... nx-1 | padding, right halo |  next row's left halo ...
struct NodeLayout {
  std::array<int, 3> size{};  ///< nodes of the block, without halo
  int halo = 0;               ///< ghost nodes on every side
  int padded_x = 0;           ///< row length rounded up to whole vectors
  std::ptrdiff_t row = 0;     ///< elements from y to y + 1
  std::ptrdiff_t plane = 0;   ///< elements from z to z + 1
  std::ptrdiff_t origin = 0;  ///< elements before node (0, 0, 0)
  std::size_t count = 0;      ///< elements in all

  NodeLayout() = default;

  /// @param lanes  elements in 64 bytes
  NodeLayout(std::array<int, 3> size_, int halo_, int lanes) : size(size_), halo(halo_) {
    const auto whole = [lanes](int n) { return (n + lanes - 1) / lanes * lanes; };
    padded_x = whole(size[0]);
    row = padded_x + whole(2 * halo);
    plane = row * (size[1] + 2 * halo);
    origin = whole(halo) + halo * (row + plane);
    count = static_cast<std::size_t>(plane) * static_cast<std::size_t>(size[2] + 2 * halo) +
            static_cast<std::size_t>(whole(halo) + lanes);
  }

  /// Offset of node (x, y, z) from node (0, 0, 0); coordinates may lie in the halo.
  std::ptrdiff_t index(int x, int y, int z) const { return x + row * y + plane * z; }
};

/// A box of nodes, lo <= node < hi, in a block's own coordinates.
struct NodeBox {
  std::array<int, 3> lo{};
  std::array<int, 3> hi{};

  std::size_t count() const {
    std::size_t n = 1;
    for (int d = 0; d < 3; ++d) n *= static_cast<std::size_t>(hi[d] - lo[d]);
    return n;
  }
};

/// Visit every row of a box: visit(offset of its first node, number of nodes).
template <class Visit>
void for_each_row(const NodeBox& box, const NodeLayout& layout, Visit visit) {
  for (int z = box.lo[2]; z < box.hi[2]; ++z)
    for (int y = box.lo[1]; y < box.hi[1]; ++y)
      visit(layout.index(box.lo[0], y, z), box.hi[0] - box.lo[0]);
}

}  // namespace hemomag::lattice
