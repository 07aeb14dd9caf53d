#pragma once
#include <array>
#include <vector>

#include "base/vec3.hpp"

namespace hemomag::lattice {

/// A field given on a regular grid, as a file holds it: metres and tesla.
struct FieldTable {
  std::array<std::size_t, 3> n{};  ///< points along each axis, at least 4
  Vec3 first;                      ///< of the grid
  Vec3 spacing;                    ///< > 0
  std::vector<Vec3> B;             ///< [z][y][x], x fastest
};

}  // namespace hemomag::lattice
