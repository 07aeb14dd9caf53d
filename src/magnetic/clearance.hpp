#pragma once
#include <optional>

#include "magnetic/field.hpp"

// Where fields hold: outside the matter of magnets and wires, inside a table's grid.

namespace hemomag::magnetic {

/// The point of a box and the point of a source's matter that are nearest to each other.
struct Gap {
  double distance = 0;
  Vec3 in_box;
};

/// Gap between the matter of a source and the box low ... high; nothing for a field without matter.
/// Alternating projections, which find it for two convex bodies (Cheney & Goldstein, Proc. AMS
/// 10:448, 1959); the ring of a loop is tried from many places.
std::optional<Gap> gap(const Shape& shape, const Vec3& low, const Vec3& high);

/// Whether the source's field is known throughout the box: false for a table that ends in it.
bool covers(const Shape& shape, const Vec3& low, const Vec3& high);

/// Least gap in nodes: nearer than this to an edge or a wire no field is smooth on the grid.
inline constexpr double least_gap = 0.01;

}  // namespace hemomag::magnetic
