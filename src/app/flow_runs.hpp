#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <mpi.h>

#include "solver/bricks.hpp"
#include "solver/fluid_solver.hpp"

// What validations of the fluid share: small flows on one rank.

namespace hemomag::app {

inline constexpr double pi = std::numbers::pi;
inline constexpr double exact = 1e-10;  // relative to the largest velocity: accumulated rounding

using fluid::Relaxation;
using fluid::VelocityGradient;
using solver::FluidParameters;
using solver::FluidSolver;
using Flow = FluidSolver::Flow;

inline Flow at_rest(const Vec3&) { return {}; }

inline std::unique_ptr<FluidSolver> make_fluid(std::array<int, 3> nodes, const FluidParameters& p) {
  return solver::make_fluid(solver::bricks(MPI_COMM_SELF, nodes, p.plate_axis), p);
}

inline void run(FluidSolver& fluid, int steps) {
  for (int t = 0; t < steps; ++t) {
    fluid.clear_forces();
    fluid.step();
  }
}

inline std::vector<Vec3> velocity(FluidSolver& fluid) {
  std::vector<double> rho(fluid.block().owned());
  std::vector<Vec3> u(rho.size());
  fluid.copy_owned(rho, u);
  return u;
}

/// Visit every node: visit(position, velocity).
template <class Visit> void for_each_node(FluidSolver& fluid, Visit visit) {
  const auto u = velocity(fluid);
  const auto n = fluid.block().size;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const int i = static_cast<int>(k) % n[0], j = static_cast<int>(k) / n[0] % n[1],
              l = static_cast<int>(k) / (n[0] * n[1]);
    visit(Vec3{i + 0.5, j + 0.5, l + 0.5}, u[k]);
  }
}

/// Largest |u - expected(position)| over the nodes.
template <class Expected> double largest_error(FluidSolver& fluid, Expected expected) {
  double worst = 0;
  for_each_node(
      fluid, [&](const Vec3& x, const Vec3& u) { worst = std::max(worst, norm(u - expected(x))); });
  return worst;
}

inline std::string with(const char* what, const char* name, double value) {
  char text[96];
  std::snprintf(text, sizeof text, "%s, %s %g", what, name, value);
  return text;
}

}  // namespace hemomag::app
