#pragma once
#include <array>
#include <cmath>

#include "base/vec3.hpp"
#include "lattice/triangle_distance.hpp"

namespace hemomag::contact {

/// Repulsion of a point from the outside of a triangulated surface, by its distance d from the
/// nearest triangle: k/2 (range - d)^2 below the range and zero beyond it. d counts negative behind
/// the triangle, so that a point that got inside is pushed out again.
struct SurfaceRepulsion {
  double stiffness = 0;  ///< k [force/length]
  double range = 0;      ///< [length]
};

inline double energy(const SurfaceRepulsion& r, double d) {
  const double depth = r.range - d;
  return depth > 0 ? 0.5 * r.stiffness * depth * depth : 0;
}

/// -dE/dd: positive pushes outwards.
inline double force(const SurfaceRepulsion& r, double d) {
  const double depth = r.range - d;
  return depth > 0 ? r.stiffness * depth : 0;
}

/// A point against a triangle.
struct PointTriangle {
  double distance = 0;           ///< negative behind the triangle
  Vec3 outward;                  ///< the distance's gradient in the point, a unit vector
  std::array<double, 3> weight;  ///< of the corners, at the nearest point of the triangle
  /// |cosine| between the way to the point and the triangle's normal. Of triangles that share the
  /// nearest point, an edge or a corner, the one with the largest tells the side.
  double facing = 1;
};

/// @param p  the point
/// @param t  corners counter-clockwise seen from outside
inline PointTriangle point_triangle(const Vec3& p, const lattice::Triangle& t) {
  const auto foot = lattice::nearest_point(p, t);
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]), way = p - foot.x;
  const double height = dot(way, normal), area2 = norm(normal), d = norm(way);
  // On the triangle itself the way has no direction.
  if (d <= 1e-12 * std::sqrt(area2)) return {0, normal / area2, foot.weight, 1};
  const double side = height < 0 ? -1 : 1;
  return {side * d, (side / d) * way, foot.weight, std::fabs(height) / (d * area2)};
}

/// Forces of the energy of the distance: on the point f, on corner k -weight[k] f. Their sum and
/// their torque vanish.
struct PointTriangleForces {
  Vec3 point;
  std::array<Vec3, 3> corner;
};
inline PointTriangleForces forces(const PointTriangle& at, double minus_dE_dd) {
  const Vec3 f = minus_dE_dd * at.outward;
  return {f, {-at.weight[0] * f, -at.weight[1] * f, -at.weight[2] * f}};
}

}  // namespace hemomag::contact
