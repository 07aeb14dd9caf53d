#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include <mpi.h>

#include "base/error.hpp"
#include "solver/bricks.hpp"
#include "solver/fluid_solver.hpp"

// The hydrodynamic radius of a point that is coupled by a kernel, measured with the fluid itself.

namespace hemomag::test {

/// R from the mobility u/F of a point in a cubic periodic box of L nodes whose fluid is at rest on
/// the whole: u/F = (1/R - 2.837297/L + (4 pi/3) R^2/L^3)/(6 pi mu) (Hasimoto, J. Fluid Mech.
/// 5:317, 1959). Density is one, so mu = nu.
inline double radius_of_mobility(double mobility, double viscosity, int L) {
  const double drag = 6 * std::numbers::pi * viscosity * mobility;
  double R = 1;
  for (int k = 0; k < 100; ++k)  // the R^2 term is small: converges by itself
    R = 1 / (drag + 2.837297 / L - 4 * std::numbers::pi / 3 * R * R / (1.0 * L * L * L));
  return R;
}

/// Steady velocity over force, along x, of one point that stands `offset` away from a node, while a
/// uniform body force takes the momentum out again.
inline double point_mobility(solver::FluidParameters parameters, int L, const Vec3& offset) {
  constexpr double force = 1e-6;  // so small that inertia, u R/nu, changes less than 1e-5
  parameters.relaxation.force[0] = -force / (1.0 * L * L * L);
  const auto at = solver::bricks(MPI_COMM_SELF, {L, L, L}, -1);
  const std::unique_ptr<solver::FluidSolver> fluid = solver::make_fluid(at, parameters);
  fluid->initialise([](const Vec3&) { return solver::FluidSolver::Flow{}; });

  const std::array<Vec3, 1> x{Vec3{L / 2 + 0.5, L / 2 + 0.5, L / 2 + 0.5} + offset};
  const std::array<Vec3, 1> f{Vec3{force, 0, 0}};
  std::array<Vec3, 1> u{};
  constexpr std::array<int, 1> mask{1};
  const ibm::Selection all{mask, 1, 0};

  const auto step = [&] {
    fluid->clear_forces();
    fluid->spread(x, all, f);
    fluid->step();
    fluid->interpolate(x, all, u);
    return u[0].x;
  };

  // The slowest mode decays by a factor e in L^2/(4 pi^2 nu) steps. What changes its sign in every
  // step and on every other node is not damped at all (it is excited at the start by kernels that
  // give even and odd nodes unlike shares, roma3 and linear2): a mean of two steps is free of it.
  const double pi = std::numbers::pi;
  const int steps = std::max(50, static_cast<int>(L * L / (4 * pi * pi * fluid->viscosity())));
  constexpr double steady = 1e-7;
  constexpr int most = 100;  // e^-16 is 1e-7: a flow that needs so much longer is not Stokes flow
  double now = 0, before = 0;
  for (int k = 0; k < most; ++k) {
    before = now;
    for (int t = 0; t < steps - 2; ++t) step();
    const double first = step();
    now = (first + step()) / 2;
    if (std::fabs(now - before) < steady * std::fabs(now)) return now / force;
  }
  throw Error("the velocity of the point does not become steady");
}

/// R of a point over all its places in a cell of the lattice.
struct PointRadius {
  double mean;  ///< of the mean mobility over the cell
  double min,
      max;  ///< over the offsets: on a node the point is smallest, in a cell's centre largest
};

/// The mean is over the cell, by Gauss-Lobatto quadrature with four points an axis on [0, 1/2]^3,
/// of which the rest of the cell is a mirror image; five points change it by less than 1e-4. The
/// force is along x, so y and z may be exchanged: 40 runs. (By cubic symmetry the mean is
/// isotropic.)
inline PointRadius point_radius(const solver::FluidParameters& parameters, int L) {
  const double inner = 0.25 * (1 - 1 / std::sqrt(5.0));
  const std::array<double, 4> at{0, inner, 0.5 - inner, 0.5};
  const std::array<double, 4> weight{1.0 / 12, 5.0 / 12, 5.0 / 12, 1.0 / 12};
  const double viscosity = parameters.relaxation.viscosity();
  double mean = 0, least = INFINITY, most = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k <= j; ++k) {
        const double mobility = point_mobility(parameters, L, {at[i], at[j], at[k]});
        mean += (j == k ? 1 : 2) * weight[i] * weight[j] * weight[k] * mobility;
        least = std::min(least, mobility);
        most = std::max(most, mobility);
      }
  return {radius_of_mobility(mean, viscosity, L), radius_of_mobility(most, viscosity, L),
          radius_of_mobility(least, viscosity, L)};
}

}  // namespace hemomag::test
