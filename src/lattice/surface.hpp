#pragma once
#include <array>
#include <vector>

#include "base/vec3.hpp"

namespace hemomag::lattice {

/// A triangulated surface. Triangles list their corners anticlockwise seen from outside.
struct Surface {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
};

}  // namespace hemomag::lattice
