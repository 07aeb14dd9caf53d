#include "lattice/surface_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lattice/triangle_crossing.hpp"
#include "lattice/triangle_distance.hpp"

namespace hemomag::lattice {
namespace {

/// A triangle of any of the surfaces.
struct Facet {
  std::size_t surface;
  std::array<int, 3> corner;  // of the surface's points
  Triangle x;
  double radius;  // about its centroid
};

Vec3 centroid(const Triangle& t) { return (1.0 / 3) * (t[0] + t[1] + t[2]); }

std::vector<Facet> facets(std::span<const SurfaceView> surfaces) {
  std::vector<Facet> all;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    for (const auto& t : surfaces[s].triangles) {
      Facet f{s, t, {}, 0};
      for (std::size_t k = 0; k < 3; ++k)
        f.x[k] = surfaces[s].points[static_cast<std::size_t>(t[k])];
      for (const Vec3& p : f.x) f.radius = std::max(f.radius, norm(p - centroid(f.x)));
      all.push_back(f);
    }
  return all;
}

bool share_a_corner(const Facet& a, const Facet& b) {
  for (const int i : a.corner)
    for (const int j : b.corner)
      if (i == j) return true;
  return false;
}

/// Points on the grid, moved by whole periods of the box, which are whole numbers of the grid too.
class Grid {
public:
  Grid(const PeriodicBox& box, double quantum) : quantum_(quantum) {
    for (std::size_t d = 0; d < 3; ++d) period_[d] = std::llround(box.size[d] / quantum);
  }
  GridTriangle operator()(const Triangle& t, const std::array<int, 3>& periods) const {
    GridTriangle g;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t d = 0; d < 3; ++d)
        g[k][d] = std::llround(t[k][d] / quantum_) + periods[d] * period_[d];
    return g;
  }

private:
  double quantum_;
  std::array<std::int64_t, 3> period_{};
};

}  // namespace

SurfaceGaps surface_gaps(std::span<const SurfaceView> surfaces, const PeriodicBox& box,
                         double range) {
  const auto all = facets(surfaces);
  std::vector<Vec3> middle;
  double widest = 0;
  for (const Facet& f : all) middle.push_back(centroid(f.x)), widest = std::max(widest, f.radius);
  const NearPoints near(middle, box, 2 * widest + range);
  // Triangles that can meet differ by less than four radii along an axis.
  const Grid grid(box, 4 * widest / static_cast<double>(largest_grid_difference));

  SurfaceGaps gaps;
  gaps.smallest = std::numeric_limits<double>::infinity();
  const auto compare = [&](std::size_t i, std::size_t j) {
    const Facet &a = all[i], &b = all[j];
    const auto periods = box.periods(middle[i] - middle[j]);
    const bool other = a.surface != b.surface || periods != std::array<int, 3>{};
    const Vec3 shift = box.shift(periods);
    const double apart = norm(middle[i] - middle[j] - shift) - a.radius - b.radius;
    const double known = std::min(gaps.smallest, range);
    if (apart > (other ? std::max(0.0, known) : 0.0)) return;
    if (!other && share_a_corner(a, b)) return;
    if (apart <= 0 && triangles_cross(grid(a.x, {}), grid(b.x, periods))) {
      if (gaps.crossings++ == 0) gaps.first_crossing = {a.surface, b.surface};
      if (other) gaps.smallest = 0;
    } else if (other) {
      const Triangle moved{b.x[0] + shift, b.x[1] + shift, b.x[2] + shift};
      const double d2 = triangle_distance2(a.x, moved);
      if (d2 < known * known) gaps.smallest = std::sqrt(d2);
    }
  };
  for (std::size_t i = 0; i < all.size(); ++i)
    near.visit_near(middle[i], [&](int j) {
      if (static_cast<std::size_t>(j) > i) compare(i, static_cast<std::size_t>(j));
    });
  return gaps;
}

}  // namespace hemomag::lattice
