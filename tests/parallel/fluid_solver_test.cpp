// The vectorised, distributed fluid against the scalar oracle, on any number of ranks.
#include "solver/fluid_solver.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "reference/lattice_reference.hpp"
#include "solver/bricks.hpp"
#include "support/grid.hpp"

namespace {

using hemomag::Vec3;
using hemomag::solver::FluidParameters;
using hemomag::solver::FluidSolver;
using hemomag::test::ReferenceFluid;

struct Points {
  std::vector<Vec3> x, f;
};

Points random_points(std::array<int, 3> n, int count) {
  std::mt19937_64 bits(7);
  const auto uniform = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
  Points p;
  for (int k = 0; k < count; ++k) {
    p.x.push_back({uniform() * n[0], uniform() * n[1], uniform() * n[2]});
    p.f.push_back({1e-3 * (uniform() - 0.5), 1e-3 * (uniform() - 0.5), 1e-3 * (uniform() - 0.5)});
  }
  return p;
}

double cosine(double r) {
  return std::fabs(r) < 2 ? 0.25 * (1 + std::cos(std::numbers::pi * r / 2)) : 0;
}

/// Visit the nodes a point touches in the reference: visit(node, weight, 0 or the plate's
/// velocity).
template <class Visit> void stencil(const ReferenceFluid& fluid, const Vec3& x, Visit visit) {
  for (int k = -2; k < 3; ++k)
    for (int j = -2; j < 3; ++j)
      for (int i = -2; i < 3; ++i) {
        const int nx = static_cast<int>(std::floor(x.x)) + i,
                  ny = static_cast<int>(std::floor(x.y)) + j,
                  nz = static_cast<int>(std::floor(x.z)) + k;
        const double weight =
            cosine(x.x - nx - 0.5) * cosine(x.y - ny - 0.5) * cosine(x.z - nz - 0.5);
        if (weight == 0) continue;
        const bool below = fluid.plates && nz < 0, above = fluid.plates && nz >= fluid.size[2];
        const int mirror = below ? -1 - nz : above ? 2 * fluid.size[2] - 1 - nz : nz;
        visit(fluid.index(nx, ny, mirror), weight,
              below   ? &fluid.lower
              : above ? &fluid.upper
                      : nullptr);
      }
}

std::pair<Vec3, hemomag::fluid::VelocityGradient> wavy(const Vec3& x, std::array<int, 3> n) {
  const double tau = 2 * std::numbers::pi;
  return {{0.02 * std::sin(tau * x.y / n[1]), 0.03 * std::cos(tau * x.z / n[2]),
           0.01 * std::sin(tau * x.x / n[0])},
          {}};
}

/// Run both for a few steps under random point forces; the velocities at the points must agree.
void compare(std::array<int, 3> n, bool plates, double tau) {
  const Points points = random_points(n, 40);
  ReferenceFluid reference(n, tau, 3.0 / 16);
  reference.plates = plates;
  FluidParameters parameters;
  parameters.relaxation.tau = tau;
  if (plates) {
    parameters.plate_axis = 2;
    parameters.plate_velocity = {Vec3{0.01, -0.02, 0}, Vec3{0, 0.04, 0}};
    reference.lower = {0.01, -0.02, 0};
    reference.upper = {0, 0.04, 0};
  }
  const auto at = hemomag::solver::bricks(MPI_COMM_WORLD, n, parameters.plate_axis);
  const auto owner = hemomag::solver::make_fluid(at, parameters);
  FluidSolver& solver = *owner;
  solver.initialise([&](const Vec3& x) { return wavy(x, n); });
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) {
        const auto [u, grad] = wavy({x + 0.5, y + 0.5, z + 0.5}, n);
        reference.f[reference.index(x, y, z)] = hemomag::fluid::populations(1.0, u, grad, tau);
      }

  const auto& block = solver.block();
  std::vector<int> mine(points.x.size());
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    mine[k] = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      const int node = static_cast<int>(std::floor(points.x[k][d]));
      if (node < block.begin[d] || node >= block.begin[d] + block.size[d]) mine[k] = 0;
    }
  }
  double largest = 0;
  for (int step = 0; step < 7; ++step) {
    for (auto& F : reference.force) F = {};
    for (std::size_t k = 0; k < points.x.size(); ++k)
      stencil(reference, points.x[k], [&](std::size_t node, double weight, const auto* plate) {
        for (std::size_t d = 0; d < 3; ++d)
          reference.force[node][d] += (plate ? -weight : weight) * points.f[k][d];
      });
    reference.step();
    solver.clear_forces();
    ASSERT_EQ(solver.spread(points.x, {mine, 1, 0}, points.f), -1);
    solver.step();
    std::vector<Vec3> u(points.x.size());
    ASSERT_EQ(solver.interpolate(points.x, {mine, 1, 0}, u), -1);
    for (std::size_t k = 0; k < points.x.size(); ++k) {
      if (!mine[k]) continue;
      Vec3 expected;
      stencil(reference, points.x[k], [&](std::size_t node, double weight, const auto* plate) {
        for (std::size_t d = 0; d < 3; ++d)
          expected[d] +=
              weight * (plate ? 2 * (*plate)[d] - reference.u[node][d] : reference.u[node][d]);
      });
      largest = std::max(largest, norm(u[k] - expected));
    }
  }
  constexpr double round_off = 1e-15;  // seven steps of 19-term sums of values below 0.1
  EXPECT_LT(largest, round_off * 10) << "on " << n[0] << " x " << n[1] << " x " << n[2];
}

TEST(FluidSolver, FollowsTheReferencePeriodic) {
  compare({16, 12, 8}, false, 1.0);
  compare({13, 11, 9}, false, 0.7);
}

TEST(FluidSolver, FollowsTheReferenceBetweenPlates) {
  compare({8, 12, 10}, true, 1.0);
  compare({11, 9, 13}, true, 0.6);
}

TEST(FluidSolver, ConservesMassAndBooksMomentum) {
  const std::array<int, 3> n{16, 12, 12};
  const Points points = random_points(n, 60);
  for (const bool plates : {false, true}) {
    FluidParameters parameters;
    parameters.plate_axis = plates ? 2 : -1;
    const auto owner = hemomag::solver::make_fluid(
        hemomag::solver::bricks(MPI_COMM_WORLD, n, parameters.plate_axis), parameters);
    FluidSolver& solver = *owner;
    solver.initialise([&](const Vec3& x) { return wavy(x, n); });
    std::vector<int> mine(points.x.size());
    Vec3 total;
    for (std::size_t k = 0; k < points.x.size(); ++k) {
      mine[k] = 1;
      for (std::size_t d = 0; d < 3; ++d) {
        const int node = static_cast<int>(std::floor(points.x[k][d]));
        if (node < solver.block().begin[d] ||
            node >= solver.block().begin[d] + solver.block().size[d])
          mine[k] = 0;
      }
      total += points.f[k];
    }
    const double mass = hemomag::test::sum_over_ranks(solver.excess_mass());
    for (int step = 0; step < 50; ++step) {
      Vec3 before = solver.momentum();
      solver.clear_forces();
      solver.spread(points.x, {mine, 1, 0}, points.f);
      solver.step();
      const Vec3 change = solver.momentum() - before;
      for (std::size_t d = 0; d < 3; ++d) {
        const double spread =
            hemomag::test::sum_over_ranks(solver.node_force()[d] + solver.wall_share()[d]);
        EXPECT_NEAR(spread, total[d], 1e-12 * 60e-3)
            << "force on nodes + plates' share = force spread";
        if (!plates) {
          EXPECT_NEAR(hemomag::test::sum_over_ranks(change[d]), total[d], 1e-12)
              << "periodic fluid takes all";
        }
      }
    }
    const double nodes = n[0] * n[1] * n[2];
    EXPECT_NEAR(hemomag::test::sum_over_ranks(solver.excess_mass()), mass, 1e-12 * nodes);
  }
}

}  // namespace
