#pragma once
#include "magnetic/field_at.hpp"

// Fields that are polynomials of the place.

namespace hemomag::magnetic {

struct UniformField {
  Vec3 B;
  FieldAt operator()(const Vec3&) const { return {B, {}}; }
};

/// The paper's one-dimensional model B = G (x_a - x0) e_a, as B0 (0, 0, z/H) and B0 (x, 0, 0).
/// It violates div B = 0: a model of the pull along one axis, not a field a magnet can make.
struct AxialGradient {
  int axis = 2;
  double slope = 0;  ///< G = dB_a/dx_a
  double zero = 0;   ///< x0
  FieldAt operator()(const Vec3& x) const {
    const auto a = static_cast<std::size_t>(axis);
    FieldAt at;
    at.B[a] = slope * (x[a] - zero);
    at.gradient[a][a] = slope;
    return at;
  }
};

/// Field of four poles, B = G [(u - u0) e_u - (v - v0) e_v] in the plane of two axes u, v: the
/// linear field with div B = 0 and curl B = 0. |B| = G times the distance from the line of zero.
struct Quadrupole {
  int u = 2, v = 0;  ///< axes of the plane
  double slope = 0;  ///< G
  Vec3 zero;
  FieldAt operator()(const Vec3& x) const {
    const auto a = static_cast<std::size_t>(u), b = static_cast<std::size_t>(v);
    FieldAt at;
    at.B[a] = slope * (x[a] - zero[a]);
    at.B[b] = -slope * (x[b] - zero[b]);
    at.gradient[a][a] = slope;
    at.gradient[b][b] = -slope;
    return at;
  }
};

}  // namespace hemomag::magnetic
