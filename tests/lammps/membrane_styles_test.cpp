// Cells through LAMMPS: free of net force and torque wherever they lie, and at rest in fluid.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "force.h"

#include "lammps/angle_hemo_membrane.h"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_watch.h"
#include "support/gradient.hpp"
#include "support/small_case.hpp"

namespace {

using namespace hemomag;

/// One cell in a periodic box without flow.
case_::Case one_cell(double box, long steps) {
  case_::Case c = test::small_case();
  c.channel.size = {box, box, box};
  c.channel.boundary = case_::Boundary::periodic;
  c.channel.shear_rate = 0;
  c.numerics.cell_reynolds.reset();
  c.numerics.dt = 6.81e-6;
  c.carriers.clear();
  c.cells[0].count = 1;
  c.cells[0].placement = case_::Placement::grid;
  c.magnetic = {};
  c.run.steps = steps;
  return c;
}

TEST(FreeCell, NetForceAndTorqueVanishAcrossBordersAndInABoxItSpans) {
  // 10 um: across the corner of the box. 8.5 um: the cell is longer than half the box and than any
  // rank's part of it.
  for (const double box : {10e-6, 8.5e-6}) {
    const case_::Case c = one_cell(box, 1);
    case_::System system = case_::place(c);
    test::Random random(3);
    for (Vec3& x : system.cells[0].x) x += random.in_cube(0.04e-6);
    test::State first;
    for (const Vec3& shift :
         {Vec3{0, 0, 0}, Vec3{box / 2, box / 2, box / 2}, Vec3{3.7e-6, -1.1e-6, 40.3e-6}}) {
      case_::System moved = system;
      for (Vec3& x : moved.cells[0].x) x += shift;
      case_::Case still = c;
      double volume = 0;
      const auto state = test::run_case_on(MPI_COMM_WORLD, still, moved, [&](lammps::Host& host) {
        auto* angle = dynamic_cast<LAMMPS_NS::AngleHemoMembrane*>(
            host.lammps().force->angle_match("hemo/membrane"));
        double mine = 0;
        for (const auto& cell : angle->cells()) mine = std::max(mine, cell.volume);
        MPI_Allreduce(&mine, &volume, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
      });
      Vec3 force, torque;
      double largest = 0;
      for (std::size_t k = 0; k < state.x.size(); ++k) {
        force += state.f[k];
        torque += cross(state.x[k] - state.x[0], state.f[k]);
        largest = std::max(largest, norm(state.f[k]));
      }
      EXPECT_GT(largest, 0);
      EXPECT_LT(norm(force), 1e-12 * largest) << "net force";
      EXPECT_LT(norm(torque), 1e-10 * largest) << "net torque (lever arms of 16 nodes, 642 terms)";
      EXPECT_NEAR(volume * std::pow(c.numerics.dx, 3),
                  membrane::enclosed_volume({system.cells[0].x, system.models[0].mesh.triangles}),
                  0.02 * 94e-18)
          << "one step after the start";
    }
  }
}

TEST(CellAtRest, KeepsAreaAndVolumeOver10000Steps) {
  const case_::Case c = one_cell(12e-6, 10000);
  LAMMPS_NS::FixHemoWatch::WatchRecord seen;
  test::run_case_on(MPI_COMM_WORLD, c, case_::place(c), [&](lammps::Host& host) {
    seen = lammps::find_fix<LAMMPS_NS::FixHemoWatch>(&host.lammps(), "hemo/watch")->record();
  });
  std::printf("cell at rest, 10,000 steps: area drift %.2e, volume drift %.2e, tolerance 1e-3\n",
              seen.area_drift_max, seen.volume_drift_max);
  EXPECT_EQ(seen.cells_end, 1);
  EXPECT_LT(seen.area_drift_max, 1e-3);
  EXPECT_LT(seen.volume_drift_max, 1e-3);
}

}  // namespace
