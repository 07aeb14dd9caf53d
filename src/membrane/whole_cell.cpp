#include "membrane/whole_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "membrane/area_volume.hpp"

namespace hemomag::membrane {

WholeCell::WholeCell(const TriangleMesh& rest, const Moduli& moduli)
    : moduli_(moduli), triangles_(rest.triangles), topology_(topology(rest)) {
  const auto& x = rest.x;
  for (const Edge& e : topology_.edges)
    springs_.push_back(
        make_spring(moduli.x0, norm(x[e.b] - x[e.a]) / moduli.x0, moduli.mu0, moduli.m));
  for (const Hinge& h : topology_.hinges) {
    const HingeAngle theta = make_hinge(x[h[0]], x[h[1]], x[h[2]], x[h[3]]).theta;
    hinges_.push_back(moduli.flat_hinges ? Bending{moduli.k_b, 0, 1}
                                         : Bending{moduli.k_b, theta.sine, theta.cosine});
  }
  for (const auto& t : triangles_)
    areas0_.push_back(0.5 * norm(twice_area_vector(x[t[0]], x[t[1]], x[t[2]])));
  area0_ = area(x);
  volume0_ = volume(x);
}

double WholeCell::area(std::span<const Vec3> x) const {
  double sum = 0;
  for (const auto& t : triangles_) sum += 0.5 * norm(twice_area_vector(x[t[0]], x[t[1]], x[t[2]]));
  return sum;
}

double WholeCell::volume(std::span<const Vec3> x) const {
  double sum = 0;
  for (const auto& t : triangles_) sum += volume_under(x[t[0]], x[t[1]], x[t[2]]);
  return sum;
}

double WholeCell::largest_extension(std::span<const Vec3> x) const {
  double most = 0;
  for (std::size_t e = 0; e < springs_.size(); ++e) {
    const auto [a, b] = topology_.edges[e];
    most = std::max(most, norm(x[b] - x[a]) / springs_[e].l_max);
  }
  return most;
}

double WholeCell::triangle_energies(std::span<const Vec3> x, std::span<Vec3> force) const {
  const double area_now = area(x), volume_now = volume(x);
  const double dE_dA = restoring(moduli_.k_a, area_now, area0_);
  const double dE_dV = restoring(moduli_.k_v, volume_now, volume0_);
  double sum =
      quadratic(moduli_.k_a, area_now, area0_) + quadratic(moduli_.k_v, volume_now, volume0_);
  for (std::size_t k = 0; k < triangles_.size(); ++k) {
    const auto& t = triangles_[k];
    const Vec3 &a = x[t[0]], &b = x[t[1]], &c = x[t[2]];
    const Vec3 twice_area = twice_area_vector(a, b, c);
    const double length = norm(twice_area), own = 0.5 * length;
    sum += quadratic(moduli_.k_d, own, areas0_[k]);
    const auto f =
        area_forces(a, b, c, twice_area / length, dE_dA + restoring(moduli_.k_d, own, areas0_[k]));
    const auto v = volume_forces(twice_area, dE_dV);
    force[t[0]] += f.a + v.a;
    force[t[1]] += f.b + v.b;
    force[t[2]] += f.c + v.c;
  }
  return sum;
}

double WholeCell::energy(std::span<const Vec3> x, std::span<Vec3> force) const {
  std::fill(force.begin(), force.end(), Vec3{});
  double sum = triangle_energies(x, force);
  for (std::size_t e = 0; e < springs_.size(); ++e) {
    const auto [a, b] = topology_.edges[e];
    const Vec3 along = x[b] - x[a];
    const double l = norm(along);
    // Nearer to its end than this a step of a minimiser could overflow.
    if (l >= 0.999 * springs_[e].l_max) return std::numeric_limits<double>::infinity();
    sum += membrane::energy(springs_[e], l);
    const Vec3 pull = (tension(springs_[e], l) / l) * along;
    force[a] += pull;
    force[b] -= pull;

    const Hinge& h = topology_.hinges[e];
    const auto hinge = make_hinge(x[h[0]], x[h[1]], x[h[2]], x[h[3]]);
    sum += membrane::energy(hinges_[e], hinge.theta);
    const auto f = forces(hinges_[e], hinge, x[h[0]], x[h[1]], x[h[3]]);
    force[h[0]] += f.f1;
    force[h[1]] += f.f2;
    force[h[2]] += f.f3;
    force[h[3]] += f.f4;
  }
  return sum;
}

}  // namespace hemomag::membrane
