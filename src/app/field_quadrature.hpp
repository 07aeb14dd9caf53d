#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "magnetic/block_magnet.hpp"
#include "magnetic/round_sources.hpp"

// Fields of magnets and coils by Gauss-Legendre quadrature of their charges and currents: slow, and
// independent of the closed forms of src/magnetic, which are held against them.

namespace hemomag::app {

struct QuadratureNode {
  double x, weight;
};

/// Nodes on [low, high]: `panels` equal parts with `order` nodes each.
inline std::vector<QuadratureNode> gauss_legendre(double low, double high, int panels, int order) {
  std::vector<QuadratureNode> unit, nodes;
  for (int k = 0; k < order; ++k) {
    double x = std::cos(std::numbers::pi * (k + 0.75) / (order + 0.5)), slope = 0;
    for (int turn = 0; turn < 100; ++turn) {  // Newton, on the Legendre polynomial of that order
      double p = 1, before = 0;
      for (int n = 1; n <= order; ++n) {
        const double next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
        before = p, p = next;
      }
      slope = order * (x * p - before) / (x * x - 1);
      const double step = p / slope;
      x -= step;
      if (std::fabs(step) < 1e-16) break;
    }
    unit.push_back({x, 2 / ((1 - x * x) * slope * slope)});
  }
  const double half = 0.5 * (high - low) / panels;
  for (int panel = 0; panel < panels; ++panel)
    for (const auto& node : unit)
      nodes.push_back({low + half * (2 * panel + 1 + node.x), half * node.weight});
  return nodes;
}

/// Field and gradient of a point charge q: q r/(4 pi r^3).
inline magnetic::FieldAt point_charge(double q, const Vec3& r) {
  const double r2 = norm2(r), c = q / (4 * std::numbers::pi * r2 * std::sqrt(r2));
  magnetic::FieldAt at;
  at.B = c * r;
  for (std::size_t a = 0; a < 3; ++a) {
    at.gradient[a] = -3 * c * r[a] / r2 * r;
    at.gradient[a][a] += c;
  }
  return at;
}

/// Field and gradient of a current element I dl: I dl x r/(4 pi r^3) (Biot-Savart).
inline magnetic::FieldAt current_element(const Vec3& I_dl, const Vec3& r) {
  const magnetic::FieldAt charge = point_charge(1, r);
  magnetic::FieldAt at;
  at.B = cross(I_dl, charge.B);
  for (std::size_t a = 0; a < 3; ++a) at.gradient[a] = cross(I_dl, charge.gradient[a]);
  return at;
}

/// A block's charges J.n on its six faces.
inline magnetic::FieldAt by_quadrature(const magnetic::BlockMagnet& magnet, const Vec3& x,
                                       int panels, int order) {
  magnetic::FieldAt sum;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    for (const auto& u : gauss_legendre(-magnet.half[b], magnet.half[b], panels, order))
      for (const auto& v : gauss_legendre(-magnet.half[c], magnet.half[c], panels, order))
        for (const double side : {-1.0, 1.0}) {
          Vec3 p;
          p[a] = side * magnet.half[a], p[b] = u.x, p[c] = v.x;
          const double q = side * magnet.remanence[a] * u.weight * v.weight;
          magnetic::add_scaled(sum, 1, point_charge(q, x - magnet.frame.place(p)));
        }
  }
  return sum;
}

/// A cylinder's charges J on its two ends.
inline magnetic::FieldAt by_quadrature(const magnetic::CylinderMagnet& magnet, const Vec3& x,
                                       int panels, int order) {
  magnetic::FieldAt sum;
  for (const auto& r : gauss_legendre(0, magnet.radius, panels, order))
    for (const auto& phi : gauss_legendre(0, 2 * std::numbers::pi, 2 * panels, order))
      for (const double side : {-1.0, 1.0}) {
        const Vec3 p{r.x * std::cos(phi.x), r.x * std::sin(phi.x), side * magnet.half};
        const double q = side * magnet.remanence * r.x * r.weight * phi.weight;
        magnetic::add_scaled(sum, 1, point_charge(q, x - magnet.frame.place(p)));
      }
  return sum;
}

inline magnetic::FieldAt by_quadrature(const magnetic::CurrentLoop& loop, const Vec3& x, int panels,
                                       int order) {
  magnetic::FieldAt sum;
  for (const auto& phi : gauss_legendre(0, 2 * std::numbers::pi, panels, order)) {
    const double c = std::cos(phi.x), s = std::sin(phi.x);
    const Vec3 p{loop.radius * c, loop.radius * s, 0};
    const Vec3 I_dl = loop.current * loop.radius * phi.weight * Vec3{-s, c, 0};
    magnetic::add_scaled(sum, 1, current_element(loop.frame.vector(I_dl), x - loop.frame.place(p)));
  }
  return sum;
}

}  // namespace hemomag::app
