#include "solver/crowd_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lattice/triangle_distance.hpp"

namespace hemomag::solver {
namespace {

lattice::Triangle corners(std::span<const Vec3> x, const std::array<int, 3>& t) {
  return {x[static_cast<std::size_t>(t[0])], x[static_cast<std::size_t>(t[1])],
          x[static_cast<std::size_t>(t[2])]};
}

}  // namespace

void CrowdContacts::build(const CrowdSurfaces& surfaces, std::span<const Vec3> x) {
  list_triangles(surfaces, x);
  list_vertices(surfaces, x);
}

void CrowdContacts::list_triangles(const CrowdSurfaces& surfaces, std::span<const Vec3> x) {
  const double reach = contact_.range + contact_.skin;
  std::vector<Vec3> middle;
  std::vector<double> radius;
  double widest = 0;
  for (const auto& t : surfaces.triangles) {
    const auto c = corners(x, t);
    middle.push_back((1.0 / 3) * (c[0] + c[1] + c[2]));
    radius.push_back(std::sqrt(std::max(
        {norm2(c[0] - middle.back()), norm2(c[1] - middle.back()), norm2(c[2] - middle.back())})));
    widest = std::max(widest, radius.back());
  }
  const lattice::NearPoints near(middle, box_, widest + reach);

  struct Candidate {
    int cell;
    std::array<int, 3> periods;
    int triangle;
    bool same_surface(const Candidate& o) const { return cell == o.cell && periods == o.periods; }
    bool operator<(const Candidate& o) const {
      return std::tie(cell, periods, triangle) < std::tie(o.cell, o.periods, o.triangle);
    }
  };
  meetings_.clear();
  near_triangles_.clear();
  std::vector<Candidate> found;
  for (std::size_t v = 0; v < x.size(); ++v) {
    found.clear();
    near.visit_near(x[v], [&](int t) {
      const auto k = static_cast<std::size_t>(t);
      const Vec3 way = x[v] - middle[k];
      const auto periods = box_.periods(way);
      const int cell = surfaces.cell[static_cast<std::size_t>(surfaces.triangles[k][0])];
      if (cell == surfaces.cell[v] && periods == std::array<int, 3>{}) return;
      const Vec3 shift = box_.shift(periods);
      const double near_enough = radius[k] + reach;
      if (norm2(way - shift) > near_enough * near_enough) return;
      const Vec3 p = x[v] - shift;
      const auto foot = lattice::nearest_point(p, corners(x, surfaces.triangles[k]));
      if (norm2(p - foot.x) < reach * reach) found.push_back({cell, periods, t});
    });
    std::sort(found.begin(), found.end());
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (k == 0 || !found[k].same_surface(found[k - 1]))
        meetings_.push_back({static_cast<int>(v), near_triangles_.size(), near_triangles_.size(),
                             box_.shift(found[k].periods)});
      near_triangles_.push_back(found[k].triangle);
      ++meetings_.back().end;
    }
  }
}

void CrowdContacts::list_vertices(const CrowdSurfaces& surfaces, std::span<const Vec3> x) {
  pairs_.clear();
  const double widest = *std::max_element(surfaces.gap.begin(), surfaces.gap.end());
  const lattice::NearPoints near(x, box_, widest + contact_.skin);
  for (std::size_t a = 0; a < x.size(); ++a)
    near.visit_near(x[a], [&](int other) {
      const auto b = static_cast<std::size_t>(other);
      if (b <= a) return;
      const Vec3 way = x[a] - x[b];
      const auto periods = box_.periods(way);
      if (surfaces.cell[a] == surfaces.cell[b] && periods == std::array<int, 3>{}) return;
      const Vec3 shift = box_.shift(periods);
      const double reach = std::max(surfaces.gap[a], surfaces.gap[b]) + contact_.skin;
      if (norm2(way - shift) < reach * reach) pairs_.push_back({static_cast<int>(a), other, shift});
    });
}

double CrowdContacts::add_forces(const CrowdSurfaces& surfaces, std::span<const Vec3> x,
                                 double scale, std::span<Vec3> f) const {
  double energy = 0;
  const double range = scale * contact_.range;
  for (const Meeting& m : meetings_) {
    const auto v = static_cast<std::size_t>(m.vertex);
    const Vec3 p = x[v] - m.shift;
    double least = range * range * (1 + 1e-9);
    const std::array<int, 3>* nearest = nullptr;
    contact::PointTriangle at;
    for (std::size_t k = m.begin; k < m.end; ++k) {
      const auto& t = surfaces.triangles[static_cast<std::size_t>(near_triangles_[k])];
      const auto c = corners(x, t);
      const double d2 = norm2(p - lattice::nearest_point(p, c).x);
      if (d2 > least * (1 + 1e-9)) continue;
      const auto here = contact::point_triangle(p, c);
      const bool same_point = nearest && d2 > least * (1 - 1e-9);
      if (same_point && here.facing <= at.facing) continue;
      least = d2, nearest = &t, at = here;
    }
    if (!nearest) continue;
    const contact::SurfaceRepulsion law{contact_.stiffness * surfaces.share[v], range};
    energy += contact::energy(law, at.distance);
    const auto pushed = contact::forces(at, contact::force(law, at.distance));
    f[v] += pushed.point;
    for (std::size_t k = 0; k < 3; ++k)
      f[static_cast<std::size_t>((*nearest)[k])] += pushed.corner[k];
  }
  for (const Pair& pair : pairs_) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    const Vec3 way = x[a] - x[b] - pair.shift;
    const double kept = scale * std::max(surfaces.gap[a], surfaces.gap[b]);
    const double d2 = norm2(way);
    if (d2 >= kept * kept || d2 == 0) continue;
    const double d = std::sqrt(d2);
    const contact::SurfaceRepulsion law{
        0.5 * contact_.stiffness * (surfaces.share[a] + surfaces.share[b]), kept};
    energy += contact::energy(law, d);
    const Vec3 push = (contact::force(law, d) / d) * way;
    f[a] += push;
    f[b] -= push;
  }
  return energy;
}

}  // namespace hemomag::solver
