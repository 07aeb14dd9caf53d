#pragma once
#include <array>
#include <cmath>

#include "base/vec3.hpp"

namespace hemomag::magnetic {

/// A field and its gradient at one point, gradient[a] = dB/dx_a; mu* = 1.
struct FieldAt {
  Vec3 B;
  std::array<Vec3, 3> gradient{};
};

/// sum += weight * at
inline void add_scaled(FieldAt& sum, double weight, const FieldAt& at) {
  sum.B += weight * at.B;
  for (std::size_t a = 0; a < 3; ++a) sum.gradient[a] += weight * at.gradient[a];
}

inline double divergence(const FieldAt& at) {
  return at.gradient[0].x + at.gradient[1].y + at.gradient[2].z;
}

inline Vec3 curl(const FieldAt& at) {
  const auto& g = at.gradient;
  return {g[1].z - g[2].y, g[2].x - g[0].z, g[0].y - g[1].x};
}

/// Square root of the sum of squares of all nine derivatives.
inline double gradient_norm(const FieldAt& at) {
  return std::sqrt(norm2(at.gradient[0]) + norm2(at.gradient[1]) + norm2(at.gradient[2]));
}

}  // namespace hemomag::magnetic
