// The vectorised, distributed fluid against the scalar oracle, on any number of ranks.
#include "solver/fluid_solver.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "lattice/vessel.hpp"
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

/// A tube along y that no node lies on the wall of.
hemomag::lattice::Tube tube_in(std::array<int, 3> n) {
  return {1, {0.5 * n[0] + 0.13, 0, 0.5 * n[2] - 0.21}, 0.5 * n[0] - 1.3};
}

struct Setup {
  std::array<int, 3> nodes;
  hemomag::fluid::Relaxation relaxation;
  bool plates = false, tube = false;
  hemomag::solver::Precision precision = hemomag::solver::Precision::double_;
};

ReferenceFluid reference_of(const Setup& setup, const FluidParameters& parameters) {
  const auto n = setup.nodes;
  ReferenceFluid reference(n, setup.relaxation.tau, setup.relaxation.magic);
  reference.plates = setup.plates;
  const auto at = [](const Vec3& v) { return std::array<double, 3>{v.x, v.y, v.z}; };
  reference.lower = at(parameters.plate_velocity[0]);
  reference.upper = at(parameters.plate_velocity[1]);
  if (setup.tube) {
    const auto tube = tube_in(n);
    reference.solid.resize(reference.nodes());
    for (int z = 0; z < n[2]; ++z)
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x)
          reference.solid[reference.index(x, y, z)] =
              tube.distance({x + 0.5, y + 0.5, z + 0.5}) <= 0;
    reference.fraction = [tube](int x, int y, int z, std::size_t i) {
      double low = 0, high = 1;
      for (int k = 0; k < 52; ++k) {
        const double q = 0.5 * (low + high);
        const auto& c = hemomag::lattice::d3q19::e[i];
        const bool wet = tube.distance(Vec3{x + 0.5, y + 0.5, z + 0.5} +
                                       q * Vec3{double(c[0]), double(c[1]), double(c[2])}) > 0;
        (wet ? low : high) = q;
      }
      return 0.5 * (low + high);
    };
  }
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) {
        const std::size_t node = reference.index(x, y, z);
        if (setup.tube && reference.solid[node]) continue;
        const auto [u, grad] = wavy({x + 0.5, y + 0.5, z + 0.5}, n);
        reference.f[node] = hemomag::fluid::populations(1.0, u, grad, setup.relaxation.tau);
        reference.u[node] = {u.x, u.y, u.z};
      }
  if (setup.relaxation.collision == hemomag::fluid::Collision::exponential)
    reference.start_exponential();
  return reference;
}

/// Run both for a few steps under random point forces; velocities must agree: at the points, and in
/// a tube (where forces are uniform) on the nodes.
void compare(const Setup& setup) {
  const auto n = setup.nodes;
  const Points points = random_points(n, 40);
  FluidParameters parameters;
  parameters.relaxation = setup.relaxation;
  parameters.precision = setup.precision;
  if (setup.plates) {
    parameters.plate_axis = 2;
    parameters.plate_velocity = {Vec3{0.01, -0.02, 0}, Vec3{0, 0.04, 0}};
  }
  if (setup.tube) {
    parameters.vessel = std::make_shared<hemomag::lattice::Tube>(tube_in(n));
    parameters.relaxation.force[1] = 1e-4;
    if (setup.relaxation.collision == hemomag::fluid::Collision::exponential)
      parameters.wall_rule = hemomag::fluid::WallRule::halfway;
  }
  ReferenceFluid reference = reference_of(setup, parameters);
  const auto at = hemomag::solver::bricks(MPI_COMM_WORLD, n, parameters.plate_axis);
  const auto owner = hemomag::solver::make_fluid(at, parameters);
  FluidSolver& solver = *owner;
  solver.initialise([&](const Vec3& x) { return wavy(x, n); });

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
    for (auto& F : reference.force) F = {0, setup.tube ? 1e-4 : 0, 0};
    solver.clear_forces();
    if (!setup.tube) {
      for (std::size_t k = 0; k < points.x.size(); ++k)
        stencil(reference, points.x[k], [&](std::size_t node, double weight, const auto* plate) {
          for (std::size_t d = 0; d < 3; ++d)
            reference.force[node][d] += (plate ? -weight : weight) * points.f[k][d];
        });
      ASSERT_EQ(solver.spread(points.x, {mine, 1, 0}, points.f), -1);
    }
    reference.step();
    solver.step();
    if (setup.tube) {
      std::vector<double> rho(block.owned());
      std::vector<Vec3> u(block.owned());
      solver.copy_owned(rho, u);
      for (std::size_t k = 0; k < u.size(); ++k) {
        const int i = static_cast<int>(k) % block.size[0],
                  j = static_cast<int>(k) / block.size[0] % block.size[1],
                  l = static_cast<int>(k) / (block.size[0] * block.size[1]);
        const auto& v =
            reference
                .u[reference.index(block.begin[0] + i, block.begin[1] + j, block.begin[2] + l)];
        largest = std::max(largest, norm(u[k] - Vec3{v[0], v[1], v[2]}));
      }
      continue;
    }
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
  // Velocities are of the size of 0.05, seven steps of 19-term sums.
  const double eps = setup.precision == hemomag::solver::Precision::single_
                         ? std::numeric_limits<float>::epsilon()
                         : std::numeric_limits<double>::epsilon();
  EXPECT_LT(largest, 64 * eps * 0.05)
      << "on " << n[0] << " x " << n[1] << " x " << n[2] << ", tau " << setup.relaxation.tau;
  EXPECT_GT(norm(hemomag::Vec3{reference.u[reference.index(n[0] / 2, 1, n[2] / 2)][0],
                               reference.u[reference.index(n[0] / 2, 1, n[2] / 2)][1], 0}),
            1e-3)
      << "nothing moves";
}

using hemomag::fluid::Relaxation;
constexpr auto single = hemomag::solver::Precision::single_;

TEST(FluidSolver, FollowsTheReferencePeriodic) {
  compare({{16, 12, 8}, {1.0, 3.0 / 16}});
  compare({{13, 11, 9}, {0.7, 3.0 / 16}});
  compare({{13, 11, 9}, Relaxation::bgk(0.8)});
  compare({{13, 11, 9}, Relaxation::exponential(0.6)});
  compare({{13, 11, 9}, {0.7, 3.0 / 16}, false, false, single});
  compare({{13, 11, 9}, Relaxation::exponential(0.6), false, false, single});
}

TEST(FluidSolver, FollowsTheReferenceBetweenPlates) {
  compare({{8, 12, 10}, {1.0, 3.0 / 16}, true});
  compare({{11, 9, 13}, {0.6, 3.0 / 16}, true});
  compare({{11, 9, 13}, Relaxation::exponential(0.4), true});
  compare({{11, 9, 13}, {0.8, 3.0 / 16}, true, false, single});
  compare({{11, 9, 13}, Relaxation::exponential(0.4), true, false, single});
}

TEST(FluidSolver, FollowsTheReferenceInATube) {
  compare({{14, 10, 14}, {0.8, 3.0 / 16}, false, true});
  compare({{14, 10, 14}, Relaxation::exponential(0.5), false, true});
  compare({{14, 10, 14}, {0.8, 3.0 / 16}, false, true, single});
}

/// Walls that are planes between nodes, at places that no node has.
class Slab : public hemomag::lattice::Vessel {
public:
  double distance(const Vec3& x) const override { return std::min(x.z - low, high - x.z); }
  static constexpr double low = 3.3, high = 16.9;
};

TEST(FluidSolver, SeesLinearFlowBeyondAVesselsWall) {
  const std::array<int, 3> n{12, 10, 20};
  FluidParameters parameters;
  parameters.kernel = hemomag::ibm::DeltaKernel::peskin4;  // exact for linear functions
  parameters.vessel = std::make_shared<Slab>();
  const auto owner =
      hemomag::solver::make_fluid(hemomag::solver::bricks(MPI_COMM_WORLD, n, -1), parameters);
  FluidSolver& solver = *owner;
  // Two flows, each linear from its own wall.
  solver.initialise([](const Vec3& x) {
    return FluidSolver::Flow{
        {0, x.z < 10 ? 0.01 * (x.z - Slab::low) : 0.02 * (Slab::high - x.z), 0}, {}};
  });
  std::vector<Vec3> x, u;
  std::vector<int> mine;
  for (const double z : {3.4, 3.9, 4.6, 5.5, 14.8, 15.7, 16.3, 16.8})
    for (const double along : {1.2, 5.1, 8.8}) {
      x.push_back({along, along, z});
      int here = 1;
      for (std::size_t d = 0; d < 3; ++d) {
        const int node = static_cast<int>(std::floor(x.back()[d]));
        if (node < solver.block().begin[d] ||
            node >= solver.block().begin[d] + solver.block().size[d])
          here = 0;
      }
      mine.push_back(here);
    }
  u.resize(x.size());
  ASSERT_EQ(solver.interpolate(x, {mine, 1, 0}, u), -1);
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!mine[k]) continue;
    const double exact = x[k].z < 10 ? 0.01 * (x[k].z - Slab::low) : 0.02 * (Slab::high - x[k].z);
    EXPECT_NEAR(u[k].y, exact, 1e-15) << "at z = " << x[k].z;
    EXPECT_NEAR(solver.wall_distance(x[k]).distance, Slab().distance(x[k]), 1e-12);
  }
}

TEST(FluidSolver, ForcesNearAVesselsWallAreBookedWhole) {
  const std::array<int, 3> n{14, 10, 14};
  FluidParameters parameters;
  parameters.vessel = std::make_shared<hemomag::lattice::Tube>(tube_in(n));
  const auto owner =
      hemomag::solver::make_fluid(hemomag::solver::bricks(MPI_COMM_WORLD, n, -1), parameters);
  FluidSolver& solver = *owner;
  solver.initialise([](const Vec3&) { return FluidSolver::Flow{}; });
  Points points = random_points(n, 300);
  std::vector<int> mine(points.x.size());
  Vec3 total;
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    mine[k] = parameters.vessel->distance(points.x[k]) > 0;
    if (mine[k]) total += points.f[k];
    for (std::size_t d = 0; d < 3; ++d) {
      const int node = static_cast<int>(std::floor(points.x[k][d]));
      if (node < solver.block().begin[d] ||
          node >= solver.block().begin[d] + solver.block().size[d])
        mine[k] = 0;
    }
  }
  solver.clear_forces();
  solver.spread(points.x, {mine, 1, 0}, points.f);
  solver.step();
  bool wall_took = false;
  for (std::size_t d = 0; d < 3; ++d) {
    const double share = hemomag::test::sum_over_ranks(solver.wall_share()[d]);
    wall_took = wall_took || std::fabs(share) > 1e-5;
    EXPECT_NEAR(hemomag::test::sum_over_ranks(solver.node_force()[d]) + share, total[d],
                1e-12 * 0.3)
        << "force on nodes + wall's share = force spread";
  }
  EXPECT_TRUE(wall_took) << "no force reached the wall";
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
