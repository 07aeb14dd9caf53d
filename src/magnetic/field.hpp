#pragma once
#include <array>
#include <variant>

#include "base/vec3.hpp"

// External magnetic fields and their exact gradients, in units where the vacuum permeability mu* is
// one.

namespace hemomag::magnetic {

/// gradient[a] = dB/dx_a.
struct FieldAt {
  Vec3 B;
  std::array<Vec3, 3> gradient{};
};

struct NoField {
  FieldAt operator()(const Vec3&) const { return {}; }
};

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

using Field = std::variant<NoField, UniformField, AxialGradient>;

inline FieldAt evaluate(const Field& field, const Vec3& x) {
  return std::visit([&](const auto& f) { return f(x); }, field);
}

}  // namespace hemomag::magnetic
