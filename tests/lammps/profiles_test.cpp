// fix hemo/profiles through LAMMPS: the same on any ranks, the cells' own volume, the momentum the
// plates take, and plasma's own viscosity without cells.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mpi.h>
#include <unistd.h>

#include "force.h"
#include "lammps.h"

#include "lammps/angle_hemo_membrane.h"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_fluid.h"
#include "lammps/fix_hemo_profiles.h"
#include "support/small_case.hpp"

namespace {

using namespace hemomag;
using LAMMPS_NS::FixHemoProfiles;

constexpr double rank_tolerance = 1e-12;  // relative to the largest value, over 21 steps
constexpr double viscosity_tolerance = 1e-6;

std::string file_of_this_process() {
  return (std::filesystem::temp_directory_path() /
          ("hemomag_profiles_" + std::to_string(getpid()) + ".csv"))
      .string();
}

struct Seen {
  std::vector<double> last;  // compute_vector
  FixHemoProfiles::Results results;
  double momentum_before = 0, momentum_after = 0, volume = 0;  // of the fluid, of all cells
  double plate = 0;                                            // area
};

/// One step, then `steps` more with one sample at their end.
Seen watch(MPI_Comm comm, case_::Case c, int steps) {
  c.run.steps = 1;
  Seen seen;
  const std::string file = file_of_this_process();
  test::run_case_on(comm, c, case_::place(c), [&](lammps::Host& host) {
    auto* fluid = lammps::find_fix<LAMMPS_NS::FixHemoFluid>(&host.lammps(), "hemo/fluid");
    seen.momentum_before = fluid->compute_vector(1);
    host.command("fix profiles all hemo/profiles " + std::to_string(steps + 1) + " " + file);
    host.command("run " + std::to_string(steps));
    auto* profiles = lammps::find_fix<FixHemoProfiles>(&host.lammps(), "hemo/profiles");
    for (int k = 0; k < 8; ++k) seen.last.push_back(profiles->compute_vector(k));
    seen.results = profiles->results();
    seen.momentum_after = fluid->compute_vector(1);
    const auto* membrane = dynamic_cast<LAMMPS_NS::AngleHemoMembrane*>(
        host.lammps().force->angle_match("hemo/membrane"));
    if (membrane)
      for (const auto& cell : membrane->cells())
        if (cell.mine) seen.volume += cell.volume;
    MPI_Allreduce(MPI_IN_PLACE, &seen.volume, 1, MPI_DOUBLE, MPI_SUM, comm);
  });
  std::filesystem::remove(file);
  const auto& size = c.channel.size;
  seen.plate = size[0] * size[1] / (c.numerics.dx * c.numerics.dx);
  return seen;
}

TEST(Profiles, AreTheSameOnAnyNumberOfRanks) {
  const auto c = test::small_case();
  const Seen alone = watch(MPI_COMM_SELF, c, 20), here = watch(MPI_COMM_WORLD, c, 20);
  for (std::size_t k = 0; k < 8; ++k)
    EXPECT_NEAR(here.last[k], alone.last[k], rank_tolerance * std::fabs(alone.last[k])) << k;
}

TEST(Profiles, HoldTheVolumeOfTheCells) {
  const auto c = test::small_case();
  const Seen seen = watch(MPI_COMM_WORLD, c, 20);
  const double height = c.channel.size[2] / c.numerics.dx;
  EXPECT_NEAR(seen.last[7] * seen.plate * height, seen.volume, 1e-10 * seen.volume);
  EXPECT_GT(seen.last[0], 0);
  EXPECT_LT(seen.last[0], height / 2);
  EXPECT_LE(seen.last[2], seen.last[0]) << "the nearest along x is nearer than the mean";
}

TEST(Profiles, ThePlatesTakeTheMomentumThatTheFluidLoses) {
  constexpr int steps = 20;  // even: populations stream in pairs of steps
  const Seen seen = watch(MPI_COMM_WORLD, test::small_case(), steps);
  const double taken = (seen.last[4] + seen.last[5]) * seen.plate * steps;
  const double lost = seen.momentum_before - seen.momentum_after;
  // Cells and carriers exert no net force along the flow. Momenta are sums over 9,072 nodes.
  std::printf("momentum: lost %.12g, taken by the plates %.12g\n", lost, taken);
  EXPECT_NEAR(taken, lost, 1e-12 * std::fabs(seen.momentum_before));
}

/// Plasma with one carrier that nothing pulls.
case_::Case plasma() {
  case_::Case c = test::small_case();
  c.cells.clear();
  c.magnetic = {};
  c.carriers[0].count = 1;
  c.channel.size = {4e-6, 4e-6, 8e-6};
  return c;
}

TEST(Profiles, PlasmaBetweenMovingPlatesHasItsOwnViscosity) {
  const Seen seen = watch(MPI_COMM_WORLD, plasma(), 20);
  ASSERT_TRUE(seen.results.relative_viscosity);
  EXPECT_NEAR(*seen.results.relative_viscosity, 1, viscosity_tolerance);
  EXPECT_EQ(seen.last[7], 0) << "no cells";
}

TEST(Profiles, PlasmaOfTheExponentialSchemeHasItsOwnViscosity) {
  case_::Case c = plasma();
  c.numerics.scheme = "exponential";
  const Seen seen = watch(MPI_COMM_WORLD, c, 20);
  ASSERT_TRUE(seen.results.relative_viscosity);
  EXPECT_NEAR(*seen.results.relative_viscosity, 1, viscosity_tolerance);
}

TEST(Profiles, DrivenPlasmaHasItsOwnViscosity) {
  case_::Case c = plasma();
  c.channel.shear_rate = 0;
  c.channel.body_force = {0, 2e4, 0};
  c.numerics.cell_reynolds.reset();
  c.numerics.dt = 6.8e-6;
  // From rest the flow is steady to exp(-pi^2 nu t/H^2) = 1e-8 after 2,900 steps; only then count.
  c.run.steps = 1;
  const std::string file = file_of_this_process();
  test::run_case_on(MPI_COMM_WORLD, c, case_::place(c), [&](lammps::Host& host) {
    host.command("run 3000 post no");
    host.command("fix profiles all hemo/profiles 100 " + file);
    host.command("run 100 post no");
    const auto r = lammps::find_fix<FixHemoProfiles>(&host.lammps(), "hemo/profiles")->results();
    ASSERT_TRUE(r.relative_viscosity);
    EXPECT_NEAR(*r.relative_viscosity, 1, viscosity_tolerance);
  });
  std::filesystem::remove(file);
}

}  // namespace
