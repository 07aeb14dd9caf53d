#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace hemomag::test {

/// Five-point central difference of f at 0, step eps^(1/5) times `length`.
template <class Function> double slope_at_zero(double length, Function f) {
  const double h = std::pow(std::numeric_limits<double>::epsilon(), 0.2) * length;
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

/// Largest |F + dE/dx| over all coordinates, relative to the largest force component.
/// @param length  over which the energy changes
template <class Energy>
double gradient_error(std::vector<Vec3> x, std::span<const Vec3> F, double length, Energy energy) {
  double worst = 0, scale = 1e-300;
  for (std::size_t k = 0; k < x.size(); ++k)
    for (std::size_t d = 0; d < 3; ++d) {
      const double at = x[k][d];
      const double slope = slope_at_zero(length, [&](double h) {
        x[k][d] = at + h;
        const double e = energy(x);
        x[k][d] = at;
        return e;
      });
      worst = std::max(worst, std::fabs(F[k][d] + slope));
      scale = std::max(scale, std::fabs(F[k][d]));
    }
  return worst / scale;
}

/// Uniform numbers and vectors, the same on every machine.
class Random {
public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double uniform(double lo = 0, double hi = 1) {
    return lo + (hi - lo) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  Vec3 in_cube(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
    return {x, y, z};
  }

private:
  std::mt19937_64 bits_;
};

}  // namespace hemomag::test
