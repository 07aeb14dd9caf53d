#include "analysis/profiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemomag::analysis {
namespace {

/// Integral from z to infinity of the part of a triangle, as a fraction of its area, that lies
/// above a height.
/// @param c  heights of the corners, ascending
double integral_above(const std::array<double, 3>& c, double z) {
  const double middle = (c[0] + c[1] + c[2]) / 3;
  if (z <= c[0]) return middle - z;
  if (z >= c[2]) return 0;
  if (z < c[1]) {
    const double d = z - c[0];
    return middle - z + d * d * d / (3 * (c[1] - c[0]) * (c[2] - c[0]));
  }
  const double d = c[2] - z;
  return d * d * d / (3 * (c[2] - c[1]) * (c[2] - c[0]));
}

}  // namespace

void add_enclosed_volume(std::span<const SurfaceTriangle> triangles, double h,
                         std::span<double> volume) {
  const int slabs = static_cast<int>(volume.size());
  for (const auto& t : triangles) {
    const double projected = cross(t.x[1] - t.x[0], t.x[2] - t.x[0]).z / 2;
    std::array<double, 3> c{t.x[0].z, t.x[1].z, t.x[2].z};
    std::sort(c.begin(), c.end());
    // Slabs below the triangle lie under all of it.
    const int whole = std::clamp(static_cast<int>(std::floor(c[0] / h)), 0, slabs);
    for (int k = 0; k < whole; ++k) volume[static_cast<std::size_t>(k)] += projected * h;
    double above = integral_above(c, whole * h);
    for (int k = whole; k < slabs && k * h < c[2]; ++k) {
      const double next = integral_above(c, (k + 1) * h);
      volume[static_cast<std::size_t>(k)] += projected * (above - next);
      above = next;
    }
  }
}

double half_core_height(std::span<const double> hematocrit, double h) {
  const std::size_t n = hematocrit.size(), quarter = n / 4;
  double core = 0;
  for (std::size_t k = quarter; k < n - quarter; ++k) core += hematocrit[k];
  const double half = 0.5 * core / static_cast<double>(n - 2 * quarter);
  const auto middle = [h](std::size_t k) { return (static_cast<double>(k) + 0.5) * h; };
  if (half <= 0) return static_cast<double>(n) * h / 2;
  if (hematocrit[0] >= half) return 0;
  for (std::size_t k = 1; k < n; ++k)
    if (hematocrit[k] >= half)
      return middle(k - 1) + h * (half - hematocrit[k - 1]) / (hematocrit[k] - hematocrit[k - 1]);
  return static_cast<double>(n) * h / 2;
}

void Moments::add(std::span<const double> values) {
  mean_.resize(values.size());
  square_.resize(values.size());
  ++count_;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double off = values[k] - mean_[k];
    mean_[k] += off / static_cast<double>(count_);
    square_[k] += off * (values[k] - mean_[k]);
  }
}

std::vector<double> Moments::state() const {
  std::vector<double> all{static_cast<double>(count_)};
  all.insert(all.end(), mean_.begin(), mean_.end());
  all.insert(all.end(), square_.begin(), square_.end());
  return all;
}

Moments Moments::from(std::span<const double> state) {
  const std::size_t size = (state.size() - 1) / 2;
  Moments m;
  m.count_ = static_cast<long>(state[0]);
  m.mean_.assign(state.begin() + 1, state.begin() + 1 + static_cast<std::ptrdiff_t>(size));
  m.square_.assign(state.begin() + 1 + static_cast<std::ptrdiff_t>(size), state.end());
  return m;
}

double Moments::deviation(std::size_t k) const {
  return count_ > 1 && k < square_.size() ? std::sqrt(square_[k] / static_cast<double>(count_ - 1))
                                          : 0;
}

}  // namespace hemomag::analysis
