#pragma once
#include <cmath>

#include "base/vec3.hpp"

// Bending at the hinges of a triangulated membrane (Eqs. 20, 52-54).
//
// A hinge is the edge p2-p3 between the triangles (p1, p2, p3) and (p4, p3, p2), both oriented
// outwards:
//
//           p3
//          /|\            n1 = (p2 - p1) x (p3 - p1)
//        p1 | p4          n2 = (p3 - p4) x (p2 - p4)
//          \|/            theta > 0: convex seen from outside
//           p2
//
// V is a vector of numbers (Vec3) or of SIMD vectors of numbers (pack.hpp), T its number.

namespace hemomag::membrane {

/// Sine and cosine of the signed angle between the normals.
template <class T> struct HingeAngleOf {
  T sine, cosine;
  double angle() const { return std::atan2(sine, cosine); }
};
using HingeAngle = HingeAngleOf<double>;

template <class V> struct HingeGeometry {
  using T = typename V::Number;
  V n1, n2;  ///< normals, twice the areas long
  V edge;    ///< p3 - p2
  T length;  ///< of the edge
  HingeAngleOf<T> theta;
};

template <class V>
[[gnu::always_inline]] inline HingeGeometry<V> make_hinge(const V& p1, const V& p2, const V& p3,
                                                          const V& p4) {
  using std::sqrt;
  HingeGeometry<V> h;
  h.n1 = cross(p2 - p1, p3 - p1);
  h.n2 = cross(p3 - p4, p2 - p4);
  h.edge = p3 - p2;
  h.length = norm(h.edge);
  const auto scale = 1.0 / sqrt(norm2(h.n1) * norm2(h.n2));
  h.theta = {dot(cross(h.n1, h.n2), h.edge) * scale / h.length, dot(h.n1, h.n2) * scale};
  return h;
}

template <class T> struct BendingOf {
  T k_b = 0;    ///< hinge stiffness [energy]
  T sine0 = 0;  ///< of the rest angle
  T cosine0 = 1;
};
using Bending = BendingOf<double>;

/// k_b [1 - cos(theta - theta0)] (Eq. 20).
inline double energy(const Bending& b, const HingeAngle& t) {
  return b.k_b * (1 - (t.cosine * b.cosine0 + t.sine * b.sine0));
}

template <class V> struct HingeForces { V f1, f2, f3, f4; };

/// F = -k_b sin(theta - theta0) grad theta. A tip that moves outwards closes the hinge by its
/// distance over the height of its triangle, grad_1 theta = -|e| n1/|n1|^2; the edge's ends balance
/// force and torque. Differs from eqs. (52)-(54): no division by sin theta, so flat hinges are
/// regular and concave ones have their right sign (the printed factor is wrong by the sign of
/// theta).
template <class V>
[[gnu::always_inline]] inline HingeForces<V> forces(const BendingOf<typename V::Number>& b,
                                                    const HingeGeometry<V>& h, const V& p1,
                                                    const V& p2, const V& p4) {
  using T = typename V::Number;
  const T moment = b.k_b * (h.theta.sine * b.cosine0 - h.theta.cosine * b.sine0);
  const V f1 = (moment * h.length / norm2(h.n1)) * h.n1;
  const V f4 = (moment * h.length / norm2(h.n2)) * h.n2;
  const T per_edge = 1.0 / (h.length * h.length);
  const T t1 = dot(p1 - p2, h.edge) * per_edge, t4 = dot(p4 - p2, h.edge) * per_edge;
  return {f1, -(1.0 - t1) * f1 - (1.0 - t4) * f4, -t1 * f1 - t4 * f4, f4};
}

}  // namespace hemomag::membrane
