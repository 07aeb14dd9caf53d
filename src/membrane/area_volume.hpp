#pragma once
#include <type_traits>

#include "base/vec3.hpp"

// Area and volume of triangles and the forces that conserve them (Eqs. 18, 19, 47-51).
// Orientation: the vertices a, b, c of a triangle run counter-clockwise seen from outside the cell,
// so that (b - a) x (c - a) points outwards.
// V is a vector of numbers (Vec3) or of SIMD vectors of numbers (pack.hpp).

namespace hemomag::membrane {

/// (b - a) x (c - a): outward normal, twice the area long.
template <class V>
[[gnu::always_inline]] constexpr V twice_area_vector(const V& a, const V& b, const V& c) {
  return cross(b - a, c - a);
}

/// Signed volume of the tetrahedron between the origin and the triangle; over a closed surface the
/// sum is the volume, wherever the origin. Signed, so that a cell need not be star-shaped.
constexpr double volume_under(const Vec3& a, const Vec3& b, const Vec3& c) {
  return dot(a, cross(b, c)) / 6;
}

template <class V> struct TriangleForces { V a, b, c; };

/// Force of an energy that depends on one triangle's area: F = -E'(A) dA/dx, with dA/da = (b - c) x
/// n / 2 (n the unit normal) and so round. The three sum to zero.
template <class V>
[[gnu::always_inline]] inline TriangleForces<V> area_forces(const V& a, const V& b, const V& c,
                                                            const V& n, typename V::Number dE_dA) {
  const typename V::Number s = -0.5 * dE_dA;
  return {s * cross(b - c, n), s * cross(c - a, n), s * cross(a - b, n)};
}

/// Force of an energy that depends on the cell's volume, F = -E'(V) dV/dx (Eq. 51). dV/da = (b x
/// c)/6 summed over the fan of triangles around a vertex equals a sixth of the sum of their
/// twice-area vectors, because the rim of the fan is closed; this form needs no origin. The three
/// do not sum to zero for one triangle, but do over a closed surface.
template <class V>
[[gnu::always_inline]] inline TriangleForces<V> volume_forces(const V& twice_area,
                                                              typename V::Number dE_dV) {
  const V third = (-dE_dV / 6.0) * twice_area;
  return {third, third, third};
}

/// dE/dX of k (X - X0)^2/(2 X0) (Eqs. 18, 19).
/// Differs from eq. (18): the global term is divided by A_t0, as Eq. 48 has it.
template <class T>
[[gnu::always_inline]] constexpr T restoring(std::type_identity_t<T> k, T x,
                                             std::type_identity_t<T> x0) {
  return k * (x - x0) / x0;
}
constexpr double quadratic(double k, double x, double x0) {
  return 0.5 * k * (x - x0) * (x - x0) / x0;
}

}  // namespace hemomag::membrane
