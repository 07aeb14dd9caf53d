// The same small case (cells across rank and periodic borders, carriers, field) on 1, 2 and 4
// ranks.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "solver/bricks.hpp"
#include "solver/fluid_solver.hpp"
#include "support/small_case.hpp"

namespace {

using namespace hemomag;

TEST(RankCount, ResultsAgreeAfter200Steps) {
  int rank = 0, ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  ASSERT_GE(ranks, 4);
  const auto c = test::small_case();
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

/// Velocity of every node after some steps of a flow without particles, on the first ranks of the
/// world.
std::vector<Vec3> flow_on(MPI_Comm comm, int plate_axis) {
  const std::array<int, 3> n{22, 18, 20};
  solver::FluidParameters p;
  p.plate_axis = plate_axis;
  p.plate_velocity = {Vec3{0, -0.01, 0}, Vec3{0, 0.03, 0}};
  p.relaxation.tau = 0.8;
  p.relaxation.force[0] = 1e-4;
  if (plate_axis == 1) p.plate_velocity = {Vec3{0.01, 0, 0}, Vec3{0, 0, 0.02}};
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
  for (const int plate_axis : {-1, 1, 2}) {
    std::vector<std::vector<Vec3>> flows;
    for (int n = 1; n <= ranks; n *= 2) {
      MPI_Comm some = MPI_COMM_NULL;
      MPI_Comm_split(MPI_COMM_WORLD, rank < n ? 0 : MPI_UNDEFINED, rank, &some);
      if (some != MPI_COMM_NULL) {
        flows.push_back(flow_on(some, plate_axis));
        MPI_Comm_free(&some);
      }
      MPI_Barrier(MPI_COMM_WORLD);
    }
    if (rank != 0) continue;
    EXPECT_GT(norm(flows[0][0]), 0);
    for (std::size_t k = 1; k < flows.size(); ++k)
      EXPECT_TRUE(flows[k] == flows[0]) << (1 << k) << " ranks differ from 1";
  }
}

}  // namespace
