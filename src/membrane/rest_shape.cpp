#include "membrane/rest_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemomag::membrane {
namespace {

constexpr auto& c = rest_shape_coefficients;

/// z/D0 over cos t, a polynomial in q = (r/D0)^2 that is positive on the whole cell.
double thickness(double q) { return c[0] + q * (c[1] + q * c[2]); }

/// d(z/D0)/dw at w = cos t, with q = (1 - w^2)/4.
double slope(double w) {
  const double q = 0.25 * (1 - w * w);
  return thickness(q) - 0.5 * w * w * (c[1] + 2 * c[2] * q);
}

/// Area of the band between w and w + dw is 2 pi D0^2 times this times dw: (R/sin t) |d(r,z)/dt| at
/// D0 = 1.
double band(double w) { return 0.5 * std::sqrt(0.25 * w * w + (1 - w * w) * slope(w) * slope(w)); }

/// Simpson's rule; the integrand is smooth and its root never vanishes, so 400 intervals reach
/// 1e-9.
double band_integral(double from, double to) {
  constexpr int intervals = 400;
  const double step = (to - from) / intervals;
  double sum = band(from) + band(to);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 == 1 ? 4 : 2) * band(from + i * step);
  return sum * step / 3;
}

}  // namespace

double rest_height(double radius, double diameter) {
  const double q = radius * radius / (diameter * diameter);
  return q >= 0.25 ? 0 : diameter * std::sqrt(1 - 4 * q) * thickness(q);
}

double rest_area(double diameter) {
  return 2 * std::numbers::pi * diameter * diameter * band_integral(-1, 1);
}

double rest_volume(double diameter) {
  return std::numbers::pi * diameter * diameter * diameter * (c[0] / 3 + c[1] / 30 + c[2] / 210);
}

double rest_area_fraction_above(double w) { return band_integral(w, 1) / band_integral(-1, 1); }

Vec3 rest_point(double t, double phi, double diameter) {
  const double r = 0.5 * diameter * std::sin(t);
  const double z = diameter * std::cos(t) * thickness(r * r / (diameter * diameter));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Vec3 project_to_rest_shape(const Vec3& p, double diameter) {
  const double r = std::hypot(p.x, p.y) / diameter;
  const double z = p.z / diameter;
  double t = std::atan2(2 * r, z / thickness(std::min(r * r, 0.25)));
  // Gauss-Newton on the squared distance: the error shrinks by curvature x distance a step.
  for (int step = 0; step < 4; ++step) {
    const double sine = std::sin(t), cosine = std::cos(t);
    const double dr = 0.5 * cosine, dz = -sine * slope(cosine);
    const double off_r = r - 0.5 * sine, off_z = z - cosine * thickness(0.25 * sine * sine);
    t += (off_r * dr + off_z * dz) / (dr * dr + dz * dz);
  }
  return rest_point(t, std::atan2(p.y, p.x), diameter);
}

}  // namespace hemomag::membrane
