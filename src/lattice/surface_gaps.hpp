#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/vec3.hpp"
#include "lattice/near_points.hpp"

namespace hemomag::lattice {

/// A closed surface by reference, in one piece: not wrapped into the box.
struct SurfaceView {
  std::span<const Vec3> points;
  std::span<const std::array<int, 3>> triangles;
};

/// How surfaces in a box lie to each other, with all their periodic images.
struct SurfaceGaps {
  /// Pairs of triangles that cross: of different surfaces, of a surface and its own image, or of
  /// one surface without a common corner.
  long crossings = 0;
  std::array<std::size_t, 2> first_crossing{};  ///< surfaces of the first such pair
  /// Smallest distance of two surfaces or of one and its image; infinite beyond the asked range.
  double smallest = 0;
};

/// Compare every triangle with those near it. Crossings are decided exactly, for corners rounded to
/// 2^-38 of the largest triangle's radius (triangle_crossing.hpp).
/// @param range  up to which gaps are looked for
/// Cost: some ten microseconds a triangle at a hematocrit of 0.45.
SurfaceGaps surface_gaps(std::span<const SurfaceView> surfaces, const PeriodicBox& box,
                         double range);

}  // namespace hemomag::lattice
