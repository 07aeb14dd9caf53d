#include "magnetic/clearance.hpp"

#include <algorithm>
#include <limits>

namespace hemomag::magnetic {
namespace {

constexpr int projections = 500;

Vec3 into(const Vec3& x, const Vec3& low, const Vec3& high) {
  return {std::clamp(x.x, low.x, high.x), std::clamp(x.y, low.y, high.y),
          std::clamp(x.z, low.z, high.z)};
}

}  // namespace

std::optional<Gap> gap(const Shape& shape, const Vec3& low, const Vec3& high) {
  return std::visit(
      [&](const auto& source) -> std::optional<Gap> {
        if constexpr (requires { source.nearest(low); }) {
          Gap least{std::numeric_limits<double>::infinity(), {}};
          for (int start = 0; start < 27; ++start) {
            const int i = start % 3, j = start / 3 % 3, layer = start / 9;
            const Vec3 share{0.5 * i, 0.5 * j, 0.5 * layer};
            Vec3 p = low;
            for (std::size_t a = 0; a < 3; ++a) p[a] += share[a] * (high[a] - low[a]);
            for (int k = 0; k < projections; ++k) p = into(source.nearest(p), low, high);
            const double distance = norm(source.nearest(p) - p);
            if (distance < least.distance) least = {distance, p};
          }
          return least;
        } else {
          return std::nullopt;
        }
      },
      shape);
}

bool covers(const Shape& shape, const Vec3& low, const Vec3& high) {
  const auto* table = std::get_if<TableField>(&shape);
  if (!table) return true;
  const Vec3 first = table->low(), last = table->high();
  for (std::size_t a = 0; a < 3; ++a) {
    const double rounding = 1e-6 * (high[a] - low[a]);
    if (first[a] > low[a] + rounding || last[a] < high[a] - rounding) return false;
  }
  return true;
}

}  // namespace hemomag::magnetic
