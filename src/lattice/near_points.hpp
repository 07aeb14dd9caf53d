#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace hemomag::lattice {

/// A box whose opposite faces are one along some axes. Positions may lie outside by any number of
/// periods, and along the other axes too.
struct PeriodicBox {
  Vec3 size;
  std::array<bool, 3> periodic{true, true, true};

  /// How many periods p lies beyond its image nearest to the origin.
  std::array<int, 3> periods(const Vec3& p) const {
    std::array<int, 3> n{};
    for (std::size_t d = 0; d < 3; ++d)
      if (periodic[d]) n[d] = static_cast<int>(std::lround(p[d] / size[d]));
    return n;
  }
  Vec3 shift(const std::array<int, 3>& n) const {
    return {n[0] * size.x, n[1] * size.y, n[2] * size.z};
  }
};

/// Points sorted into bins, to find those near a place.
class NearPoints {
public:
  /// @param reach  the largest distance that will be asked about; under half a period
  NearPoints(std::span<const Vec3> points, const PeriodicBox& box, double reach) : box_(box) {
    std::size_t bins = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      n_[d] = std::clamp(static_cast<int>(box.size[d] / reach), 1, most_bins);
      bins *= static_cast<std::size_t>(n_[d]);
    }
    std::vector<std::size_t> bin;
    bin.reserve(points.size());
    for (const Vec3& p : points) bin.push_back(number(index(p, 0), index(p, 1), index(p, 2)));
    first_.assign(bins + 1, 0);
    for (const std::size_t b : bin) ++first_[b + 1];
    for (std::size_t b = 0; b < bins; ++b) first_[b + 1] += first_[b];
    points_.resize(points.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) points_[next[bin[i]]++] = static_cast<int>(i);
  }

  /// visit(i) for every point within reach of x and some that are farther, in a fixed order.
  template <class Visit> void visit_near(const Vec3& x, Visit visit) const {
    std::array<std::array<int, 3>, 3> at{};
    std::array<int, 3> count{};
    for (std::size_t d = 0; d < 3; ++d) {
      const int middle = index(x, d);
      for (int k = middle - 1; k <= middle + 1; ++k) {
        const int wrapped = box_.periodic[d] ? (k + n_[d]) % n_[d] : k;
        if (wrapped < 0 || wrapped >= n_[d]) continue;
        const auto end = at[d].begin() + count[d];
        if (std::find(at[d].begin(), end, wrapped) == end)
          at[d][static_cast<std::size_t>(count[d]++)] = wrapped;
      }
    }
    for (int c = 0; c < count[2]; ++c)
      for (int b = 0; b < count[1]; ++b)
        for (int a = 0; a < count[0]; ++a) {
          const std::size_t bin =
              number(at[0][static_cast<std::size_t>(a)], at[1][static_cast<std::size_t>(b)],
                     at[2][static_cast<std::size_t>(c)]);
          for (std::size_t k = first_[bin]; k < first_[bin + 1]; ++k) visit(points_[k]);
        }
  }

private:
  static constexpr int most_bins = 400;  // along an axis

  int index(const Vec3& x, std::size_t d) const {
    const double share = x[d] / box_.size[d];
    const int k = static_cast<int>(std::floor(
        (box_.periodic[d] ? share - std::floor(share) : std::clamp(share, 0.0, 1.0)) * n_[d]));
    return std::min(k, n_[d] - 1);
  }
  std::size_t number(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(n_[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(n_[0]) +
           static_cast<std::size_t>(i);
  }

  PeriodicBox box_;
  std::array<int, 3> n_{};
  std::vector<std::size_t> first_;  // of each bin, in points_
  std::vector<int> points_;
};

}  // namespace hemomag::lattice
