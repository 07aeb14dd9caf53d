#include "analysis/cell_free_layer.hpp"

#include <algorithm>
#include <cmath>

namespace hemomag::analysis {

FacingSurfaces::FacingSurfaces(const Vec3& channel, double spacing) : channel_(channel) {
  for (std::size_t d = 0; d < 2; ++d) {
    n_[d] = std::max(1, static_cast<int>(std::ceil(channel[d] / spacing - 1e-9)));
    step_[d] = channel[d] / n_[d];
  }
  distance_.resize(2 * static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]));
  clear();
}

void FacingSurfaces::clear() { std::fill(distance_.begin(), distance_.end(), channel_.z / 2); }

void FacingSurfaces::add(std::span<const SurfaceTriangle> triangles) {
  for (const auto& t : triangles) add_triangle(t);
}

/// Columns whose middle the triangle covers; on an edge both neighbours may take it.
void FacingSurfaces::add_triangle(const SurfaceTriangle& t) {
  const Vec3 &a = t.x[0], &b = t.x[1], &c = t.x[2];
  const Vec3 n = cross(b - a, c - a);
  if (n.z == 0) return;  // seen edge-on: its neighbours have the same column
  int from[2], to[2];
  for (std::size_t d = 0; d < 2; ++d) {
    from[d] = static_cast<int>(std::ceil(std::min({a[d], b[d], c[d]}) / step_[d] - 0.5));
    to[d] = static_cast<int>(std::floor(std::max({a[d], b[d], c[d]}) / step_[d] - 0.5));
  }
  const auto wrap = [](int i, int count) {
    return static_cast<std::size_t>((i % count + count) % count);
  };
  const auto side = [sense = n.z > 0 ? 1.0 : -1.0](const Vec3& p, const Vec3& q, double x,
                                                   double y) {
    return sense * ((q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x));
  };
  const std::size_t columns = distance_.size() / 2;
  for (int j = from[1]; j <= to[1]; ++j)
    for (int i = from[0]; i <= to[0]; ++i) {
      const double x = (i + 0.5) * step_[0], y = (j + 0.5) * step_[1];
      if (side(a, b, x, y) < 0 || side(b, c, x, y) < 0 || side(c, a, x, y) < 0) continue;
      const double z = a.z - ((x - a.x) * n.x + (y - a.y) * n.y) / n.z;
      const std::size_t at = wrap(j, n_[1]) * static_cast<std::size_t>(n_[0]) + wrap(i, n_[0]);
      distance_[at] = std::min(distance_[at], z);
      distance_[columns + at] = std::min(distance_[columns + at], channel_.z - z);
    }
}

CellFreeLayer FacingSurfaces::layer(int plate) const {
  const auto nx = static_cast<std::size_t>(n_[0]), ny = static_cast<std::size_t>(n_[1]);
  const double* row = &distance_[static_cast<std::size_t>(plate) * nx * ny];
  CellFreeLayer layer;
  for (std::size_t j = 0; j < ny; ++j, row += nx) {
    for (std::size_t i = 0; i < nx; ++i) layer.mean += row[i];
    layer.seen += *std::min_element(row, row + nx);
  }
  layer.mean /= static_cast<double>(nx * ny);
  layer.seen /= static_cast<double>(ny);
  return layer;
}

}  // namespace hemomag::analysis
