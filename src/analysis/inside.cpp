#include "analysis/inside.hpp"

#include <algorithm>
#include <cmath>

namespace hemomag::analysis {
namespace {

/// True when (x, y) lies strictly to the left of the edge a -> b, or on it and the edge is taken
/// so; the arithmetic is done from the end with the smaller tag, so that the neighbour on the edge
/// gets exactly the opposite answer.
bool left_of(const Vec3& a, std::int64_t tag_a, const Vec3& b, std::int64_t tag_b, const Vec3& p) {
  const bool swapped = tag_b < tag_a;
  const Vec3& first = swapped ? b : a;
  const Vec3& second = swapped ? a : b;
  const double side =
      (second.x - first.x) * (p.y - first.y) - (second.y - first.y) * (p.x - first.x);
  const bool left = side > 0;
  return swapped ? !left : left;
}

/// Points sorted into columns over the x-y plane.
class Columns {
public:
  Columns(std::span<const Vec3> points, const ChannelBox& box) : box_(box) {
    const double per_axis = std::sqrt(static_cast<double>(points.size())) + 1;
    n_[0] = n_[1] = std::clamp(static_cast<int>(per_axis), 1, 512);
    columns_.resize(static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]));
    for (std::size_t k = 0; k < points.size(); ++k)
      columns_[at(column(points[k].x, 0), column(points[k].y, 1))].push_back(k);
  }

  /// visit(point) for points in columns that the rectangle, or an image of it, touches; each column
  /// once.
  template <class Visit> void for_each_near(const Vec3& lo, const Vec3& hi, Visit visit) const {
    const int i0 = column(lo.x, 0), i1 = std::min(column(hi.x, 0), i0 + n_[0] - 1);
    const int j0 = column(lo.y, 1), j1 = std::min(column(hi.y, 1), j0 + n_[1] - 1);
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i)
        for (const std::size_t k : columns_[at(i, j)]) visit(k);
  }

private:
  int column(double x, std::size_t d) const {
    return static_cast<int>(std::floor(x / box_.size[d] * n_[d]));
  }
  std::size_t at(int i, int j) const {
    const auto wrap = [](int a, int n) { return static_cast<std::size_t>((a % n + n) % n); };
    return wrap(j, n_[1]) * static_cast<std::size_t>(n_[0]) + wrap(i, n_[0]);
  }
  ChannelBox box_;
  int n_[2];
  std::vector<std::vector<std::size_t>> columns_;
};

}  // namespace

std::vector<int> enclosure(std::span<const Vec3> points, std::span<const SurfaceTriangle> triangles,
                           const ChannelBox& box) {
  std::vector<int> times(points.size(), 0);
  const Columns columns(points, box);
  for (const auto& t : triangles) {
    const Vec3 &a = t.x[0], &b = t.x[1], &c = t.x[2];
    const Vec3 lo{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), 0};
    const Vec3 hi{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), 0};
    columns.for_each_near(lo, hi, [&](std::size_t k) {
      Vec3 p = points[k];
      p.x += box.size.x * std::round(((lo.x + hi.x) / 2 - p.x) / box.size.x);
      p.y += box.size.y * std::round(((lo.y + hi.y) / 2 - p.y) / box.size.y);
      const bool ab = left_of(a, t.tag[0], b, t.tag[1], p),
                 bc = left_of(b, t.tag[1], c, t.tag[2], p),
                 ca = left_of(c, t.tag[2], a, t.tag[0], p);
      if (ab != bc || bc != ca) return;
      const Vec3 n = cross(b - a, c - a);
      if (n.z == 0) return;  // seen edge-on: its neighbours take the ray
      const double z = a.z - ((p.x - a.x) * n.x + (p.y - a.y) * n.y) / n.z;
      const int sense = ab ? 1 : -1;  // counter-clockwise from above: the normal points up
      const int images =
          box.periodic_z ? static_cast<int>(std::floor((z - p.z) / box.size.z)) : (z > p.z ? 1 : 0);
      times[k] += sense * images;
    });
  }
  return times;
}

}  // namespace hemomag::analysis
