#pragma once
#include <array>
#include <cmath>

#include "base/vec3.hpp"
#include "lattice/triangle_distance.hpp"

namespace hemomag::contact {

/// Repulsion of a point from a triangle, by its distance d from it: F = k R (R - d)/d below the
/// range R, zero beyond. It begins with the stiffness k and has no end: no force brings the point
/// to the triangle, from either side. E = k R [R ln(R/d) - (R - d)].
///
/// A point in front of a surface feels every triangle within the range, one in front of a face and
/// up to six or seven at a vertex: the sum is smooth, needs no rank to know which triangle is
/// nearest, and holds the point a little farther off at vertices than in the middle of faces.
struct SurfaceBarrier {
  double stiffness = 0;  ///< k [force/length] at d = R
  double range = 0;      ///< R [length]
};

inline double energy(const SurfaceBarrier& b, double d) {
  if (d >= b.range) return 0;
  return b.stiffness * b.range * (b.range * std::log(b.range / d) - (b.range - d));
}

/// -dE/dd, from 0 < d.
inline double force(const SurfaceBarrier& b, double d) {
  return d < b.range ? b.stiffness * b.range * (b.range - d) / d : 0;
}

/// Forces on the point and on the corners of the triangle, where the barycentric weights of the
/// nearest point share it out: their sum and their torque vanish.
struct BarrierForces {
  double energy = 0;
  Vec3 point;
  std::array<Vec3, 3> corner;
};

/// All zero beyond the range, and on the triangle itself, where no direction is away.
inline BarrierForces barrier_forces(const SurfaceBarrier& b, const Vec3& p,
                                    const lattice::Triangle& t) {
  const auto foot = lattice::nearest_point(p, t);
  const Vec3 way = p - foot.x;
  const double d2 = norm2(way);
  if (d2 >= b.range * b.range || d2 == 0) return {};
  const double d = std::sqrt(d2);
  const Vec3 f = (force(b, d) / d) * way;
  return {energy(b, d), f, {-foot.weight[0] * f, -foot.weight[1] * f, -foot.weight[2] * f}};
}

}  // namespace hemomag::contact
