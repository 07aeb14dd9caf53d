#include "magnetic/table_field.hpp"

#include <algorithm>
#include <span>

namespace hemomag::magnetic {
namespace {

/// Coefficients c_-1 ... c_n of the cubic B-spline through n >= 4 equidistant values:
/// (c_i-1 + 4 c_i + c_i+1)/6 = f_i. Not-a-knot, the same cubic left and right of the second point,
/// makes c_1 = f_1 - (f_0 - 2 f_1 + f_2)/6, and the same at the other end; what lies between is a
/// tridiagonal system (Thomas).
/// @param line  [n + 2] values in 1 ... n on entry, coefficients on return
/// @param work  [n + 2]
void to_coefficients(std::span<Vec3> line, std::span<double> work) {
  const std::size_t n = line.size() - 2;  // f_i is line[i + 1]
  const Vec3 f0 = line[1], f1 = line[2], f2 = line[3];
  const Vec3 g0 = line[n], g1 = line[n - 1], g2 = line[n - 2];
  line[2] = f1 - (f0 - 2 * f1 + f2) / 6;
  line[n - 1] = g1 - (g0 - 2 * g1 + g2) / 6;
  // Forward: c_i = line[i] - work[i] c_i+1.
  work[2] = 0;
  for (std::size_t i = 3; i + 1 < n; ++i) {
    const double pivot = 1 / (4 - work[i - 1]);
    work[i] = pivot;
    line[i] = pivot * (6 * line[i] - line[i - 1]);
  }
  for (std::size_t i = n - 2; i >= 3; --i) line[i] -= work[i] * line[i + 1];
  line[1] = 6 * f1 - 4 * line[2] - line[3];
  line[0] = 6 * f0 - 4 * line[1] - line[2];
  line[n] = 6 * g1 - 4 * line[n - 1] - line[n - 2];
  line[n + 1] = 6 * g0 - 4 * line[n] - line[n - 1];
}

/// Weights of the four coefficients about a place, and their derivatives by the coordinate.
struct Weights {
  std::size_t first;
  std::array<double, 4> value, slope;

  Weights(double x, double first_x, double spacing, std::size_t n) {
    const double u = (x - first_x) / spacing;
    const double cell = std::clamp(std::floor(u), 0.0, static_cast<double>(n - 2));
    first = static_cast<std::size_t>(cell);
    const double t = u - cell, r = 1 - t;
    value = {r * r * r / 6, (4 + t * t * (3 * t - 6)) / 6, (4 + r * r * (3 * r - 6)) / 6,
             t * t * t / 6};
    slope = {-r * r / 2 / spacing, t * (1.5 * t - 2) / spacing, -r * (1.5 * r - 2) / spacing,
             t * t / 2 / spacing};
  }
};

}  // namespace

TableField::TableField(const lattice::FieldTable& table, const Vec3& origin, double per_metre,
                       double per_tesla)
    : first_(origin + per_metre * table.first), spacing_(per_metre * table.spacing), n_(table.n) {
  const std::array<std::size_t, 3> m{n_[0] + 2, n_[1] + 2, n_[2] + 2};
  const std::array<std::size_t, 3> stride{1, m[0], m[0] * m[1]};
  auto all = std::make_shared<std::vector<Vec3>>(m[0] * m[1] * m[2]);
  for (std::size_t k = 0; k < n_[2]; ++k)
    for (std::size_t j = 0; j < n_[1]; ++j)
      for (std::size_t i = 0; i < n_[0]; ++i)
        (*all)[(i + 1) + stride[1] * (j + 1) + stride[2] * (k + 1)] =
            per_tesla * table.B[i + n_[0] * (j + n_[1] * k)];
  std::vector<Vec3> line;
  std::vector<double> work;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    line.resize(m[a]), work.resize(m[a]);
    // Lines beyond the faces of an axis that is still to come hold zeros and are harmless.
    for (std::size_t j = 0; j < m[b]; ++j)
      for (std::size_t k = 0; k < m[c]; ++k) {
        Vec3* start = all->data() + stride[b] * j + stride[c] * k;
        for (std::size_t i = 0; i < m[a]; ++i) line[i] = start[stride[a] * i];
        to_coefficients(line, work);
        for (std::size_t i = 0; i < m[a]; ++i) start[stride[a] * i] = line[i];
      }
  }
  coefficients_ = std::move(all);
}

Vec3 TableField::high() const {
  Vec3 x = first_;
  for (std::size_t a = 0; a < 3; ++a) x[a] += static_cast<double>(n_[a] - 1) * spacing_[a];
  return x;
}

FieldAt TableField::operator()(const Vec3& x) const {
  const Weights wx(x.x, first_.x, spacing_.x, n_[0]), wy(x.y, first_.y, spacing_.y, n_[1]),
      wz(x.z, first_.z, spacing_.z, n_[2]);
  const std::size_t row = n_[0] + 2, sheet = row * (n_[1] + 2);
  const Vec3* corner = coefficients_->data() + wx.first + row * wy.first + sheet * wz.first;
  FieldAt at;
  for (std::size_t k = 0; k < 4; ++k) {
    Vec3 B, Bx, By;  // of this sheet
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec3* c = corner + row * j + sheet * k;
      Vec3 value, slope;  // of this row
      for (std::size_t i = 0; i < 4; ++i) value += wx.value[i] * c[i], slope += wx.slope[i] * c[i];
      B += wy.value[j] * value;
      Bx += wy.value[j] * slope;
      By += wy.slope[j] * value;
    }
    at.B += wz.value[k] * B;
    at.gradient[0] += wz.value[k] * Bx;
    at.gradient[1] += wz.value[k] * By;
    at.gradient[2] += wz.slope[k] * B;
  }
  return at;
}

}  // namespace hemomag::magnetic
