// Membrane forces, energies and virial through LAMMPS: the same on any number of ranks, and of one
// another.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "angle.h"
#include "bond.h"
#include "dihedral.h"
#include "force.h"

#include "support/gradient.hpp"
#include "support/small_case.hpp"

namespace {

using namespace hemomag;

/// Cells in a periodic box without flow, forces at the start only.
case_::Case still_cells(int count) {
  case_::Case c = test::small_case();
  c.channel.size = {10e-6, 10e-6, 5e-6 * count};
  c.channel.boundary = case_::Boundary::periodic;
  c.channel.shear_rate = 0;
  c.numerics.cell_reynolds.reset();
  c.numerics.dt = 6.81e-6;
  c.carriers.clear();
  c.cells[0].count = count;
  c.cells[0].placement = case_::Placement::grid;
  c.magnetic = {};
  c.run.steps = 0;
  return c;
}

/// Moved over the borders of the box, and away from rest.
case_::System stirred(const case_::Case& c) {
  case_::System system = case_::place(c);
  test::Random random(5);
  for (auto& cell : system.cells)
    for (Vec3& x : cell.x) x += Vec3{4.3e-6, 2.2e-6, 1.1e-6} + random.in_cube(0.03e-6);
  return system;
}

struct Outcome {
  test::State state;
  double energy = 0;
  std::array<double, 6> virial{};
};

Outcome forces_on(MPI_Comm comm, const case_::Case& c, const case_::System& system) {
  Outcome outcome;
  outcome.state = test::run_case_on(comm, c, system, [&](lammps::Host& host) {
    host.command("compute virial all pressure NULL virial");
    host.command("thermo_style custom step ebond eangle edihed c_virial[1]");
    host.command("run 0");
    const auto& force = *host.lammps().force;
    std::array<double, 7> mine{force.bond->energy + force.angle->energy + force.dihedral->energy};
    for (std::size_t d = 0; d < 6; ++d)
      mine[d + 1] = force.bond->virial[d] + force.angle->virial[d] + force.dihedral->virial[d];
    std::array<double, 7> all{};
    MPI_Allreduce(mine.data(), all.data(), 7, MPI_DOUBLE, MPI_SUM, comm);
    outcome.energy = all[0];
    std::copy(all.begin() + 1, all.end(), outcome.virial.begin());
  });
  return outcome;
}

double largest_force(const test::State& state) {
  double largest = 0;
  for (const Vec3& f : state.f) largest = std::max(largest, norm(f));
  return largest;
}

TEST(MembraneRanks, ForcesEnergyAndVirialAgreeOn1To8Ranks) {
  int rank = 0, ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  ASSERT_GE(ranks, 8);
  const case_::Case c = still_cells(3);
  const case_::System system = stirred(c);
  std::vector<Outcome> outcomes;
  for (const int n : {1, 2, 4, 8}) {
    MPI_Comm some = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank < n ? 0 : MPI_UNDEFINED, rank, &some);
    if (some != MPI_COMM_NULL) {
      outcomes.push_back(forces_on(some, c, system));
      MPI_Comm_free(&some);
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  if (rank != 0) return;
  const Outcome& one = outcomes[0];
  const double largest = largest_force(one.state);
  EXPECT_GT(largest, 0);
  EXPECT_GT(one.energy, 0);
  double virial_scale = 0;
  for (std::size_t k = 0; k < one.state.x.size(); ++k)
    virial_scale += norm(one.state.f[k]);  // lever arms of a node and more
  for (std::size_t s = 1; s < 4; ++s) {
    const Outcome& other = outcomes[s];
    double worst = 0;
    for (std::size_t k = 0; k < one.state.f.size(); ++k)
      worst = std::max(worst, norm(other.state.f[k] - one.state.f[k]));
    std::printf("%d ranks against 1: largest difference of a force %.2e of the largest, tolerance "
                "1e-12\n",
                1 << s, worst / largest);
    EXPECT_LT(worst, 1e-12 * largest);
    EXPECT_NEAR(other.energy, one.energy, 1e-12 * one.energy);
    for (std::size_t d = 0; d < 6; ++d)
      EXPECT_NEAR(other.virial[d], one.virial[d], 1e-12 * virial_scale);
  }
}

TEST(MembraneRanks, TheVirialIsThatOfTheForcesAndTheForcesAreTheEnergysSlope) {
  const case_::Case c = still_cells(1);
  const case_::System system = stirred(c);
  const Outcome here = forces_on(MPI_COMM_WORLD, c, system);
  // Over a cell in one piece, sum x_i f_j; its net force vanishes, so that the origin is free.
  std::array<double, 6> expected{};
  double scale = 0;
  constexpr std::size_t pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  for (std::size_t k = 0; k < here.state.x.size(); ++k) {
    const Vec3 arm = here.state.x[k] - here.state.x[0];
    for (std::size_t d = 0; d < 6; ++d)
      expected[d] += arm[pair[d][0]] * here.state.f[k][pair[d][1]];
    scale += norm(arm) * norm(here.state.f[k]);
  }
  constexpr double round_off = 1e-12;  // 642 vertices of 20 terms
  for (std::size_t d = 0; d < 6; ++d)
    EXPECT_NEAR(here.virial[d], expected[d], round_off * scale) << "component " << d;

  test::Random random(6);
  const double h = 1e-4;  // nodes: differences of second order, over edges of one node
  std::vector<Vec3> direction(system.cells[0].x.size());
  for (Vec3& d : direction) d = random.in_cube(1);
  const auto energy_at = [&](double step) {
    case_::System moved = system;
    for (std::size_t k = 0; k < direction.size(); ++k)
      moved.cells[0].x[k] += (step * c.numerics.dx) * direction[k];
    return forces_on(MPI_COMM_WORLD, c, moved).energy;
  };
  // Fourth order in the step.
  const double slope =
      (8 * (energy_at(h) - energy_at(-h)) - (energy_at(2 * h) - energy_at(-2 * h))) / (12 * h);
  double work = 0, size = 0;
  for (std::size_t k = 0; k < direction.size(); ++k) {
    work += dot(here.state.f[k], direction[k]);
    size += norm(here.state.f[k]) * norm(direction[k]);
  }
  EXPECT_NEAR(slope, -work, 1e-7 * size);
}

TEST(MembraneRanks, NewCoefficientsBetweenRunsCountAndExponentsMayDiffer) {
  const case_::Case c = still_cells(1);
  const case_::System system = stirred(c);
  test::run_case_on(MPI_COMM_WORLD, c, system, [&](lammps::Host& host) {
    auto* atom = host.lammps().atom;
    const auto forces = [&](const std::string& low_types, const std::string& high_types) {
      host.command("bond_coeff 1*900 " + low_types);
      host.command("bond_coeff 901* " + high_types);
      host.command("run 0");
      std::vector<Vec3> mine(642), all(642);
      for (int i = 0; i < atom->nlocal; ++i)
        mine[static_cast<std::size_t>(atom->tag[i] - 1)] = {atom->f[i][0], atom->f[i][1],
                                                            atom->f[i][2]};
      MPI_Allreduce(&mine[0].x, &all[0].x, 3 * 642, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
      return all;
    };
    host.command("unfix watch");  // the springs are alone: no rest volume is meant
    host.command("angle_coeff * 0 1 0 1 0 1 0 1");
    host.command("dihedral_coeff * 0 0");
    const std::string none = "1 0.45 4 1e-30 2 0 0", square = "1 0.45 4 0.01 2 0 0",
                      twice = "1 0.45 4 0.02 2 0 0", steep = "1 0.45 4 0.01 2.7 0 0";
    const auto low = forces(square, none), high = forces(none, steep);
    const auto both = forces(square, steep), doubled = forces(twice, none);
    double largest = 0;
    for (const Vec3& f : both) largest = std::max(largest, norm(f));
    EXPECT_GT(largest, 0);
    for (std::size_t k = 0; k < 642; ++k) {
      EXPECT_LT(norm(both[k] - low[k] - high[k]), 1e-13 * largest);
      EXPECT_LT(norm(doubled[k] - 2 * low[k]), 1e-13 * largest);
    }
  });
}

}  // namespace
