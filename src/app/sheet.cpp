#include "app/sheet.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/minimise.hpp"
#include "membrane/area_volume.hpp"
#include "membrane/triangulation.hpp"

namespace hemomag::app {
namespace {

constexpr Vec3 up{0, 0, 1};

/// Strains xx, yy, xy (engineering) of the plane, symmetric: no rotation.
struct Strain {
  double xx = 0, yy = 0, xy = 0;
  Vec3 operator()(const Vec3& v) const {
    return {(1 + xx) * v.x + 0.5 * xy * v.y, 0.5 * xy * v.x + (1 + yy) * v.y, 0};
  }
};

/// The sheet's springs and areas under a strain of its box.
class StrainedSheet {
public:
  StrainedSheet(const Sheet& sheet, const membrane::Moduli& moduli)
      : sheet_(sheet), moduli_(moduli) {
    for (const auto& t : sheet.triangles) {
      for (std::size_t j = 0; j < 3; ++j) {
        const auto &a = t[j], &b = t[(j + 1) % 3];
        if (a.vertex > b.vertex) continue;  // the neighbour has it the other way round
        const double l0 = norm(place(b, sheet.x, {}) - place(a, sheet.x, {}));
        edges_.push_back(
            {a, b, membrane::make_spring(moduli.x0, l0 / moduli.x0, moduli.mu0, moduli.m), 0});
        edges_.back().rest_energy = membrane::energy(edges_.back().spring, l0);
      }
      areas_.push_back(0.5 * twice_area(t, sheet.x, {}).z);
    }
  }

  double rest_area() const { return sheet_.width * sheet_.height; }

  /// Energy above the rest state.
  double energy(const Strain& strain, const std::vector<Vec3>& x, std::vector<Vec3>& f) const {
    std::fill(f.begin(), f.end(), Vec3{});
    const double area =
        rest_area() * ((1 + strain.xx) * (1 + strain.yy) - 0.25 * strain.xy * strain.xy);
    double sum = membrane::quadratic(moduli_.k_a, area, rest_area());
    for (const auto& e : edges_) {
      const Vec3 along = place(e.b, x, strain) - place(e.a, x, strain);
      const double l = norm(along);
      if (l >= e.spring.l_max) return std::numeric_limits<double>::infinity();
      sum += membrane::energy(e.spring, l) - e.rest_energy;
      const Vec3 pull = (membrane::tension(e.spring, l) / l) * along;
      f[e.a.vertex] += pull;
      f[e.b.vertex] -= pull;
    }
    for (std::size_t k = 0; k < areas_.size(); ++k) {
      const auto& t = sheet_.triangles[k];
      const double own = 0.5 * twice_area(t, x, strain).z;
      sum += membrane::quadratic(moduli_.k_d, own, areas_[k]);
      const auto force = membrane::area_forces(place(t[0], x, strain), place(t[1], x, strain),
                                               place(t[2], x, strain), up,
                                               membrane::restoring(moduli_.k_d, own, areas_[k]));
      f[t[0].vertex] += force.a;
      f[t[1].vertex] += force.b;
      f[t[2].vertex] += force.c;
    }
    return sum;
  }

  /// Energy per area of the relaxed sheet.
  double density(const Strain& strain) const {
    std::vector<Vec3> x;
    for (const Vec3& p : sheet_.x) x.push_back(strain(p));
    MinimiseOptions how;
    how.largest_force = 1e-9 * moduli_.mu0 * std::sqrt(rest_area() / static_cast<double>(x.size()));
    const auto found = minimise(
        x, [&](const auto& at, auto& f) { return energy(strain, at, f); }, how);
    return found.energy / rest_area();
  }

private:
  struct SheetEdge {
    Sheet::Corner a, b;
    membrane::Spring spring;
    double rest_energy;
  };

  Vec3 place(const Sheet::Corner& c, const std::vector<Vec3>& x, const Strain& strain) const {
    return x[c.vertex] + strain({c.image[0] * sheet_.width, c.image[1] * sheet_.height, 0});
  }
  Vec3 twice_area(const std::array<Sheet::Corner, 3>& t, const std::vector<Vec3>& x,
                  const Strain& strain) const {
    return membrane::twice_area_vector(place(t[0], x, strain), place(t[1], x, strain),
                                       place(t[2], x, strain));
  }

  const Sheet& sheet_;
  membrane::Moduli moduli_;
  std::vector<SheetEdge> edges_;
  std::vector<double> areas_;
};

/// Delaunay triangulation of a periodic plane. Points and their images near the box are laid on a
/// sphere, where circles stay circles: the convex hull there is the Delaunay triangulation here, if
/// the pole from which they are laid is one of its points.
std::vector<std::array<Sheet::Corner, 3>> periodic_delaunay(const Sheet& s) {
  const double margin = 6 * std::sqrt(s.width * s.height / static_cast<double>(s.x.size()));
  std::vector<Sheet::Corner> corners;
  std::vector<Vec3> flat, round;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int v = 0; v < static_cast<int>(s.x.size()); ++v) {
        const Vec3 p = s.x[v] + Vec3{i * s.width, j * s.height, 0};
        if (p.x < -margin || p.x > s.width + margin || p.y < -margin || p.y > s.height + margin)
          continue;
        corners.push_back({v, {i, j}});
        flat.push_back(p);
        const Vec3 q = (p - Vec3{0.5 * s.width, 0.5 * s.height, 0}) / s.width;
        const double r2 = norm2(q);
        round.push_back(Vec3{2 * q.x, 2 * q.y, r2 - 1} / (1 + r2));
      }
  const int pole = static_cast<int>(round.size());
  round.push_back(up);
  std::vector<std::array<Sheet::Corner, 3>> triangles;
  for (auto t : membrane::triangulate_sphere(round)) {
    if (t[0] == pole || t[1] == pole || t[2] == pole) continue;
    if (cross(flat[t[1]] - flat[t[0]], flat[t[2]] - flat[t[0]]).z < 0) std::swap(t[1], t[2]);
    const Vec3 centre = (flat[t[0]] + flat[t[1]] + flat[t[2]]) / 3;
    if (centre.x < 0 || centre.x >= s.width || centre.y < 0 || centre.y >= s.height) continue;
    triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  }
  if (triangles.size() != 2 * s.x.size())
    throw Error("sheet: " + std::to_string(triangles.size()) + " triangles of " +
                std::to_string(s.x.size()) + " vertices, expected twice as many");
  return triangles;
}

}  // namespace

Sheet regular_sheet(int columns, int double_rows, double edge) {
  Sheet s;
  const double rise = edge * std::sqrt(0.75);
  const int rows = 2 * double_rows;
  s.width = columns * edge;
  s.height = rows * rise;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) s.x.push_back({(i + 0.5 * (j % 2)) * edge, j * rise, 0});
  const auto corner = [&](int i, int j) {
    return Sheet::Corner{j % rows * columns + i % columns, {i / columns, j / rows}};
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      // Odd rows stand half an edge to the right: the vertex above and right of i is i + odd.
      const int odd = j % 2;
      const auto a = corner(i, j), b = corner(i + 1, j);
      s.triangles.push_back(odd ? std::array{a, corner(i + 1, j + 1), corner(i, j + 1)}
                                : std::array{a, b, corner(i, j + 1)});
      s.triangles.push_back(odd ? std::array{a, b, corner(i + 1, j + 1)}
                                : std::array{b, corner(i + 1, j + 1), corner(i, j + 1)});
    }
  return s;
}

Sheet irregular_sheet(int vertices, double edge, std::uint64_t seed) {
  Sheet s;
  s.width = s.height = edge * std::sqrt(vertices * std::sqrt(0.75));
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int v = 0; v < vertices; ++v) {
    const double x = s.width * uniform(), y = s.height * uniform();
    s.x.push_back({x, y, 0});
  }
  constexpr int steps = 60;
  for (int step = 0; step < steps; ++step) {
    s.triangles = periodic_delaunay(s);
    // Every vertex goes to the centre of the triangles around it, weighted by their areas.
    std::vector<Vec3> move(s.x.size());
    std::vector<double> weight(s.x.size(), 0);
    for (const auto& t : s.triangles) {
      std::array<Vec3, 3> p;
      for (std::size_t j = 0; j < 3; ++j)
        p[j] = s.x[t[j].vertex] + Vec3{t[j].image[0] * s.width, t[j].image[1] * s.height, 0};
      const double area = membrane::twice_area_vector(p[0], p[1], p[2]).z;
      for (std::size_t j = 0; j < 3; ++j) {
        move[t[j].vertex] += area * ((p[0] + p[1] + p[2]) / 3 - p[j]);
        weight[t[j].vertex] += area;
      }
    }
    for (std::size_t v = 0; v < s.x.size(); ++v) {
      Vec3& p = s.x[v];
      p += move[v] / weight[v];
      p.x -= s.width * std::floor(p.x / s.width);
      p.y -= s.height * std::floor(p.y / s.height);
    }
  }
  s.triangles = periodic_delaunay(s);
  return s;
}

Elasticity Elasticity::turned(double degrees) const {
  const double c = std::cos(degrees * std::numbers::pi / 180);
  const double s = std::sin(degrees * std::numbers::pi / 180);
  // Strains in the old axes of a strain in the new ones; energy is the same in both.
  const double R[3][3] = {
      {c * c, s * s, -c * s}, {s * s, c * c, c * s}, {2 * c * s, -2 * c * s, c * c - s * s}};
  Elasticity e;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) e.C[i][j] += R[k][i] * C[k][l] * R[l][j];
  return e;
}

double Elasticity::youngs() const {
  // Of the two strains that the pull leaves free, by Cramer's rule.
  const double minor = C[1][1] * C[2][2] - C[1][2] * C[1][2];
  const double det = C[0][0] * minor - C[0][1] * (C[0][1] * C[2][2] - C[1][2] * C[0][2]) +
                     C[0][2] * (C[0][1] * C[1][2] - C[1][1] * C[0][2]);
  return det / minor;
}

Elasticity elasticity(const Sheet& sheet, const membrane::Moduli& moduli) {
  const StrainedSheet strained(sheet, moduli);
  constexpr double h = 1e-3;  // terms of h^2 and rounding over h^2 are both below 1e-4
  const double rest = strained.density({});
  const auto curvature = [&](double xx, double yy, double xy) {
    return (strained.density({h * xx, h * yy, h * xy}) - 2 * rest +
            strained.density({-h * xx, -h * yy, -h * xy})) /
           (h * h);
  };
  Elasticity e;
  const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::size_t i = 0; i < 3; ++i) e.C[i][i] = curvature(unit[i][0], unit[i][1], unit[i][2]);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 3; ++j) {
      const double both =
          curvature(unit[i][0] + unit[j][0], unit[i][1] + unit[j][1], unit[i][2] + unit[j][2]);
      e.C[i][j] = e.C[j][i] = 0.5 * (both - e.C[i][i] - e.C[j][j]);
    }
  return e;
}

}  // namespace hemomag::app
