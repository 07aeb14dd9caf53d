#include "membrane/rest_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemomag::membrane {
namespace {

using Coefficients = std::array<double, 3>;

/// z/D over cos t, a polynomial in q = (r/D)^2 that is positive on the whole cell.
double thickness(const Coefficients& c, double q) { return c[0] + q * (c[1] + q * c[2]); }

/// d(z/D)/dw at w = cos t, with q = (1 - w^2)/4.
double slope(const Coefficients& c, double w) {
  const double q = 0.25 * (1 - w * w);
  return thickness(c, q) - 0.5 * w * w * (c[1] + 2 * c[2] * q);
}

/// Area of the band between w and w + dw is 2 pi D^2 times this times dw: (R/sin t) |d(r,z)/dt| at
/// D = 1.
double band(const Coefficients& c, double w) {
  return 0.5 * std::sqrt(0.25 * w * w + (1 - w * w) * slope(c, w) * slope(c, w));
}

/// Simpson's rule; the integrand is smooth and its root never vanishes, so 400 intervals reach
/// 1e-9.
double band_integral(const Coefficients& c, double from, double to) {
  constexpr int intervals = 400;
  const double step = (to - from) / intervals;
  double sum = band(c, from) + band(c, to);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 == 1 ? 4 : 2) * band(c, from + i * step);
  return sum * step / 3;
}

}  // namespace

double rest_height(const RestShape& shape, double radius) {
  const double D = shape.diameter, q = radius * radius / (D * D);
  return q >= 0.25 ? 0 : D * std::sqrt(1 - 4 * q) * thickness(shape.c, q);
}

double rest_area(const RestShape& shape) {
  return 2 * std::numbers::pi * shape.diameter * shape.diameter * band_integral(shape.c, -1, 1);
}

double rest_volume(const RestShape& shape) {
  const double D = shape.diameter;
  return std::numbers::pi * D * D * D * (shape.c[0] / 3 + shape.c[1] / 30 + shape.c[2] / 210);
}

double rest_area_fraction_above(const RestShape& shape, double w) {
  return band_integral(shape.c, w, 1) / band_integral(shape.c, -1, 1);
}

CosineOfAreaFraction::CosineOfAreaFraction(const RestShape& shape) {
  constexpr int rows = 2000;
  for (int k = 0; k <= rows; ++k)
    fraction_.push_back(rest_area_fraction_above(shape, 1 - 2.0 * k / rows));
}

double CosineOfAreaFraction::operator()(double fraction) const {
  const auto rows = static_cast<double>(fraction_.size() - 1);
  const auto next = std::lower_bound(fraction_.begin() + 1, fraction_.end() - 1, fraction);
  const double within = (fraction - next[-1]) / (next[0] - next[-1]);
  const double row = static_cast<double>(next - fraction_.begin()) - 1 + within;
  return std::clamp(1 - 2.0 * row / rows, -1.0, 1.0);
}

Vec3 rest_point(const RestShape& shape, double t, double phi) {
  const double D = shape.diameter, r = 0.5 * D * std::sin(t);
  const double z = D * std::cos(t) * thickness(shape.c, r * r / (D * D));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

double meridian_angle(const RestShape& shape, const Vec3& p) {
  const auto& c = shape.c;
  const double r = std::hypot(p.x, p.y) / shape.diameter;
  const double z = p.z / shape.diameter;
  double t = std::atan2(2 * r, z / thickness(c, std::min(r * r, 0.25)));
  // Gauss-Newton on the squared distance: the error shrinks by curvature x distance a step.
  for (int step = 0; step < 4; ++step) {
    const double sine = std::sin(t), cosine = std::cos(t);
    const double dr = 0.5 * cosine, dz = -sine * slope(c, cosine);
    const double off_r = r - 0.5 * sine, off_z = z - cosine * thickness(c, 0.25 * sine * sine);
    t += (off_r * dr + off_z * dz) / (dr * dr + dz * dz);
  }
  return t;
}

Vec3 project_to_rest_shape(const RestShape& shape, const Vec3& p) {
  return rest_point(shape, meridian_angle(shape, p), std::atan2(p.y, p.x));
}

}  // namespace hemomag::membrane
