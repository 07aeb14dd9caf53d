#pragma once
#include <array>
#include <cstdint>

namespace hemomag::lattice {

/// A point on a grid of integers, on which the sides of planes are exact.
using GridPoint = std::array<std::int64_t, 3>;
using GridTriangle = std::array<GridPoint, 3>;

/// Largest difference of coordinates of two triangles that are compared: determinants of such
/// differences then fit into 127 bits.
inline constexpr std::int64_t largest_grid_difference = std::int64_t{1} << 40;

/// Whether two triangles have a point in common. A touch is a crossing, and so is an overlap in a
/// common plane; triangles without an area are taken as the segment or point that they are, and for
/// crossing where their boxes overlap. Exact: integers throughout.
///
/// Two triangles meet just if an edge of one meets the other (Moeller, J. Graphics Tools 2(2):25,
/// 1997, from the signs of the same determinants).
bool triangles_cross(const GridTriangle& s, const GridTriangle& t);

}  // namespace hemomag::lattice
