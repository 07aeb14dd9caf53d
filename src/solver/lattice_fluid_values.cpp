#include <algorithm>
#include <cmath>

#include "lattice/d3q19.hpp"
#include "solver/lattice_fluid.hpp"

// What is read from the fluid: densities, velocities, sums.

namespace hemomag::solver {
namespace {

namespace d3q19 = lattice::d3q19;

}  // namespace

/// Visit the 19 populations of every owned node as they will be collided next: visit(node in
/// x-fastest order, g).
template <class Real>
template <class Visit>
void LatticeFluid<Real>::for_each_population(Visit visit) {
  const bool shifted = next_ == fluid::Pass::shift;
  if (shifted) {  // only fills ghosts and solid nodes: the next step may do it again
    send_populations_forward();
    bounce_before_shift();
  }
  std::size_t node = 0;
  for (int z = 0; z < block().size[2]; ++z)
    for (int y = 0; y < block().size[1]; ++y)
      for (int x = 0; x < block().size[0]; ++x, ++node) {
        if (!wet(n_layout_.index(x, y, z))) continue;
        std::array<double, 19> g;
        for (std::size_t i = 0; i < 19; ++i) {
          const auto& c = d3q19::e[i];
          g[i] = static_cast<double>(shifted ? f_[static_cast<std::size_t>(d3q19::opposite[i])]
                                                 [f_layout_.index(x - c[0], y - c[1], z - c[2])]
                                             : f_[i][f_layout_.index(x, y, z)]);
        }
        visit(node, g);
      }
}

/// Visit rows of fluid nodes: visit(offset in the node layout, offset in the population layout,
/// index of the node in x-fastest order), node by node.
template <class Real>
template <class Visit>
void LatticeFluid<Real>::for_each_fluid_row(Visit visit) const {
  std::size_t index = 0;
  for (int z = 0; z < block().size[2]; ++z)
    for (int y = 0; y < block().size[1]; ++y) {
      const std::ptrdiff_t node = n_layout_.index(0, y, z), at = f_layout_.index(0, y, z);
      for (int x = 0; x < block().size[0]; ++x, ++index)
        if (wet(node + x)) visit(node + x, at + x, index);
    }
}

/// Exponential scheme: rho - 1 of the last step.
template <class Real> double LatticeFluid<Real>::excess_density(std::ptrdiff_t at) const {
  return static_cast<double>(last_[0][at]) +
         (static_cast<double>(last_[4][at]) + static_cast<double>(last_[5][at]) +
          static_cast<double>(last_[6][at])) /
             3;
}

template <class Real>
void LatticeFluid<Real>::copy_owned(std::span<double> rho, std::span<Vec3> u) {
  std::fill(rho.begin(), rho.end(), 1.0);
  std::fill(u.begin(), u.end(), Vec3{});
  for_each_fluid_row([&](std::ptrdiff_t node, std::ptrdiff_t at, std::size_t index) {
    u[index] = {double(u_[0][node]), double(u_[1][node]), double(u_[2][node])};
    if (exponential()) rho[index] += excess_density(at);
  });
  if (!exponential())
    for_each_population([&](std::size_t node, const std::array<double, 19>& g) {
      double drho = 0;
      for (const double g_i : g) drho += g_i;
      rho[node] = 1 + drho;
    });
}

template <class Real> FluidSolver::Fastest LatticeFluid<Real>::fastest() const {
  double largest = 0;
  std::size_t at = 0;
  for_each_fluid_row([&](std::ptrdiff_t node, std::ptrdiff_t, std::size_t index) {
    const double x = u_[0][node], y = u_[1][node], z = u_[2][node], u2 = x * x + y * y + z * z;
    if (u2 <= largest || std::isnan(largest)) return;  // a NaN wins
    largest = u2;
    at = index;
  });
  const auto& n = block().size;
  const auto coordinate = [&](int d, std::size_t i) {
    return block().begin[static_cast<std::size_t>(d)] + static_cast<int>(i);
  };
  const auto nx = static_cast<std::size_t>(n[0]), ny = static_cast<std::size_t>(n[1]);
  return {std::sqrt(largest),
          {coordinate(0, at % nx), coordinate(1, at / nx % ny), coordinate(2, at / (nx * ny))}};
}

template <class Real> Vec3 LatticeFluid<Real>::total_velocity() const {
  Vec3 sum;
  for_each_fluid_row([&](std::ptrdiff_t node, std::ptrdiff_t, std::size_t) {
    sum += {double(u_[0][node]), double(u_[1][node]), double(u_[2][node])};
  });
  return sum;
}

template <class Real> double LatticeFluid<Real>::fluid_nodes() const {
  double count = 0;
  for_each_fluid_row([&](std::ptrdiff_t, std::ptrdiff_t, std::size_t) { count += 1; });
  return count;
}

template <class Real> Vec3 LatticeFluid<Real>::node_force() const {
  Vec3 sum;
  for_each_fluid_row([&](std::ptrdiff_t node, std::ptrdiff_t, std::size_t) {
    sum += {double(force_[0][node]), double(force_[1][node]), double(force_[2][node])};
  });
  return sum;
}

template <class Real> double LatticeFluid<Real>::excess_mass() {
  double mass = 0;
  if (exponential())
    for_each_fluid_row(
        [&](std::ptrdiff_t, std::ptrdiff_t at, std::size_t) { mass += excess_density(at); });
  else
    for_each_population([&](std::size_t, const std::array<double, 19>& g) {
      for (const double g_i : g) mass += g_i;
    });
  return mass;
}

template <class Real> Vec3 LatticeFluid<Real>::momentum() {
  Vec3 j;
  if (exponential())
    for_each_fluid_row([&](std::ptrdiff_t node, std::ptrdiff_t at, std::size_t) {
      j += (1 + excess_density(at)) *
           Vec3{double(u_[0][node]), double(u_[1][node]), double(u_[2][node])};
    });
  else
    for_each_population([&](std::size_t, const std::array<double, 19>& g) {
      for (std::size_t i = 0; i < 19; ++i)
        j += g[i] * Vec3{double(d3q19::e[i][0]), double(d3q19::e[i][1]), double(d3q19::e[i][2])};
    });
  return j;
}

template <class Real> WallDistance LatticeFluid<Real>::wall_distance(const Vec3& x) const {
  int at[3];
  double t[3];
  for (std::size_t d = 0; d < 3; ++d) {
    const double local = x[d] - block().begin[d] - 0.5;
    at[d] = std::clamp(static_cast<int>(std::floor(local)), -n_layout_.halo,
                       block().size[d] + n_layout_.halo - 2);
    t[d] = local - at[d];
  }
  WallDistance wall{};
  for (int corner = 0; corner < 8; ++corner) {
    const int c[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
    const double value =
        static_cast<double>(distance_[n_layout_.index(at[0] + c[0], at[1] + c[1], at[2] + c[2])]);
    double weight[3];
    for (int d = 0; d < 3; ++d) weight[d] = c[d] ? t[d] : 1 - t[d];
    wall.distance += value * weight[0] * weight[1] * weight[2];
    wall.gradient += value * Vec3{(c[0] ? 1 : -1) * weight[1] * weight[2],
                                  (c[1] ? 1 : -1) * weight[0] * weight[2],
                                  (c[2] ? 1 : -1) * weight[0] * weight[1]};
  }
  return wall;
}

template <class Real> std::size_t LatticeFluid<Real>::bytes() const {
  return sizeof(Real) *
         (f_storage_.size() + force_storage_.size() + u_storage_.size() + distance_storage_.size());
}

template class LatticeFluid<double>;  // the members defined here
template class LatticeFluid<float>;

}  // namespace hemomag::solver
