// The same small case (cells across rank and periodic borders, carriers, field) on 1, 2 and 4
// ranks.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "lattice/vessel.hpp"
#include "solver/bricks.hpp"
#include "solver/fluid_solver.hpp"
#include "support/small_case.hpp"

namespace {

using namespace hemomag;

/// The case on 1, 2 and 4 of the ranks; all three on rank 0 of the world.
std::vector<test::State> on_1_2_4_ranks(const case_::Case& c) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const auto system = case_::place(c);
  std::vector<test::State> states;
  for (const int n : {1, 2, 4}) {
    MPI_Comm some = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank < n ? 0 : MPI_UNDEFINED, rank, &some);
    if (some != MPI_COMM_NULL) {
      states.push_back(test::run_case_on(some, c, system, [](lammps::Host&) {}));
      MPI_Comm_free(&some);
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  return states;
}

/// Carriers with inertia that have met and stick together, in sub-steps.
TEST(RankCount, CarriersWithInertiaAgreeAfter400Steps) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  auto c = test::small_case();
  c.cells.clear();
  c.carriers[0].count = 600;
  c.carriers[0].density = 5200;
  c.magnetic.sources[0].B0 = 0.15;
  c.run.steps = 400;
  const auto states = on_1_2_4_ranks(c);
  if (rank != 0) return;
  ASSERT_EQ(states.size(), 3u);
  int touching = 0;
  for (std::size_t i = 0; i < 600; ++i)
    for (std::size_t j = 0; j < i; ++j)
      touching += norm(states[0].x[i] - states[0].x[j]) < 1.02 * 0.5;
  EXPECT_GT(touching, 50) << "of 250 nm, 0.5 nodes";
  for (std::size_t s = 1; s < 3; ++s) {
    double worst = 0;
    for (std::size_t k = 0; k < states[0].x.size(); ++k)
      worst = std::max(worst, norm(states[s].x[k] - states[0].x[k]));
    std::printf("carriers, %d ranks against 1: positions differ by up to %.2e of the box\n",
                s == 1 ? 2 : 4, worst / 28);
    EXPECT_LT(worst / 28, 1e-12);
  }
}

TEST(RankCount, ResultsAgreeAfter200Steps) {
  int rank = 0, ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  ASSERT_GE(ranks, 4);
  const auto states = on_1_2_4_ranks(test::small_case());
  if (rank != 0) return;
  ASSERT_EQ(states.size(), 3u);
  ASSERT_EQ(states[0].x.size(), 2u * 642 + 12);
  // The case must cross the borders it is about.
  bool crosses = false;
  for (std::size_t k = 0; k < 1284; ++k)
    crosses = crosses || states[0].x[k].y < 0 || states[0].x[k].y > 28 || states[0].x[k].x < 0 ||
              states[0].x[k].x > 18;
  EXPECT_TRUE(crosses) << "no cell lies across a periodic border";
  for (std::size_t s = 1; s < 3; ++s) {
    double worst = 0;
    for (std::size_t k = 0; k < states[0].x.size(); ++k)
      worst = std::max(worst, norm(states[s].x[k] - states[0].x[k]));
    const double scale = 28;  // the box, in nodes
    std::printf(
        "%d ranks against 1: largest difference of a position %.2e of the box, tolerance 1e-10\n",
        s == 1 ? 2 : 4, worst / scale);
    EXPECT_LT(worst / scale, 1e-10);
  }
}

TEST(RankCount, TwoRunsAreTheSameToTheLastBit) {
  const auto c = test::small_case();
  const auto system = case_::place(c);
  const auto first = test::run_case_on(MPI_COMM_WORLD, c, system, [](lammps::Host&) {});
  const auto second = test::run_case_on(MPI_COMM_WORLD, c, system, [](lammps::Host&) {});
  EXPECT_TRUE(first.x == second.x);
  EXPECT_TRUE(first.f == second.f);
}

enum class Walls { none, plates_x, plates_y, plates_z, tube, tube_halfway };

/// Velocity of every node after some steps of a flow without particles, on the first ranks of the
/// world.
std::vector<Vec3> flow_on(MPI_Comm comm, Walls walls, const fluid::Relaxation& relaxation,
                          solver::Precision precision) {
  const std::array<int, 3> n{22, 18, 20};
  const int plate_axis = walls == Walls::plates_x   ? 0
                         : walls == Walls::plates_y ? 1
                         : walls == Walls::plates_z ? 2
                                                    : -1;
  solver::FluidParameters p;
  p.relaxation = relaxation;
  p.precision = precision;
  p.plate_axis = plate_axis;
  p.plate_velocity = {Vec3{0.01, -0.01, 0.005}, Vec3{0, 0.03, 0.02}};
  if (plate_axis >= 0)
    for (Vec3& velocity : p.plate_velocity) velocity[static_cast<std::size_t>(plate_axis)] = 0;
  p.relaxation.force[0] = 1e-4;
  if (walls == Walls::tube || walls == Walls::tube_halfway) {
    p.vessel = std::make_shared<lattice::Tube>(0, Vec3{0, 9.2, 9.9}, 8.1);
    p.wall_rule = walls == Walls::tube ? fluid::WallRule::interpolated : fluid::WallRule::halfway;
  }
  const auto owner = solver::make_fluid(solver::bricks(comm, n, plate_axis), p);
  solver::FluidSolver& fluid = *owner;
  fluid.initialise([](const Vec3& x) {
    std::pair<Vec3, fluid::VelocityGradient> flow;
    flow.first = {0.02 * std::sin(x.y), 0.03 * std::cos(x.z), 0.01 * std::sin(x.x)};
    return flow;
  });
  for (int t = 0; t < 51; ++t) fluid.step();
  const auto& block = fluid.block();
  std::vector<double> rho(block.owned());
  std::vector<Vec3> u(block.owned()), all(22 * 18 * 20), sum(all.size());
  fluid.copy_owned(rho, u);
  for (std::size_t k = 0; k < u.size(); ++k) {
    const int i = static_cast<int>(k) % block.size[0],
              j = static_cast<int>(k) / block.size[0] % block.size[1],
              l = static_cast<int>(k) / (block.size[0] * block.size[1]);
    all[static_cast<std::size_t>(((block.begin[2] + l) * 18 + block.begin[1] + j) * 22 +
                                 block.begin[0] + i)] = u[k];
  }
  MPI_Allreduce(&all[0].x, &sum[0].x, static_cast<int>(3 * all.size()), MPI_DOUBLE, MPI_SUM, comm);
  return sum;
}

TEST(RankCount, AFlowWithoutParticlesIsTheSameToTheLastBit) {
  int rank = 0, ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  using enum Walls;
  for (const Walls walls : {none, plates_x, plates_y, plates_z, tube, tube_halfway})
    for (const auto& relaxation : {fluid::Relaxation{0.8, 3.0 / 16}, fluid::Relaxation::bgk(0.8),
                                   fluid::Relaxation::exponential(0.5)})
      for (const auto precision : {solver::Precision::double_, solver::Precision::single_}) {
        std::vector<std::vector<Vec3>> flows;
        for (int n = 1; n <= ranks; n *= 2) {
          MPI_Comm some = MPI_COMM_NULL;
          MPI_Comm_split(MPI_COMM_WORLD, rank < n ? 0 : MPI_UNDEFINED, rank, &some);
          if (some != MPI_COMM_NULL) {
            flows.push_back(flow_on(some, walls, relaxation, precision));
            MPI_Comm_free(&some);
          }
          MPI_Barrier(MPI_COMM_WORLD);
        }
        if (rank != 0) continue;
        EXPECT_GT(norm(flows[0][(10 * 18 + 9) * 22 + 5]), 0);
        for (std::size_t k = 1; k < flows.size(); ++k)
          EXPECT_TRUE(flows[k] == flows[0])
              << (1 << k) << " ranks differ from 1, walls " << static_cast<int>(walls)
              << ", collision " << static_cast<int>(relaxation.collision);
      }
}

}  // namespace
