// Cells of other kinds, and with springs at rest elsewhere, through LAMMPS in plasma at rest.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "lammps/compat.hpp"
#include "lammps/fix_hemo_watch.h"
#include "support/small_case.hpp"

namespace {

using namespace hemomag;

case_::Case at_rest(const case_::Cell& cell, double box, long steps) {
  case_::Case c = test::small_case();
  c.channel.size = {box, box, box};
  c.channel.boundary = case_::Boundary::periodic;
  c.channel.shear_rate = 0;
  c.numerics.cell_reynolds.reset();
  c.numerics.dt = 6.81e-6;
  c.carriers.clear();
  c.cells = {cell};
  c.cells[0].hematocrit.reset();
  c.cells[0].count = 1;
  c.cells[0].placement = case_::Placement::grid;
  c.magnetic = {};
  c.run.steps = steps;
  return c;
}

struct Outcome {
  LAMMPS_NS::FixHemoWatch::WatchRecord seen;
  double start = 0, end = 0;  ///< largest distance of a vertex from its place in the mesh [m]
};

/// @param stretch  of the cell along x at the start, its volume kept
Outcome run(const case_::Case& c, double stretch) {
  Outcome result;
  auto system = case_::place(c);
  const auto mesh = system.cells[0].x;
  Vec3 middle;
  for (const Vec3& x : mesh) middle += x / static_cast<double>(mesh.size());
  for (Vec3& x : system.cells[0].x)
    for (std::size_t d = 0; d < 3; ++d)
      x[d] = middle[d] + (x[d] - middle[d]) * (d == 0 ? stretch : 1 / std::sqrt(stretch));
  const auto state = test::run_case_on(MPI_COMM_WORLD, c, system, [&](lammps::Host& host) {
    result.seen = lammps::find_fix<LAMMPS_NS::FixHemoWatch>(&host.lammps(), "hemo/watch")->record();
  });
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    result.start = std::max(result.start, norm(system.cells[0].x[v] - mesh[v]));
    result.end = std::max(result.end, norm(c.numerics.dx * state.x[v] - mesh[v]));
  }
  std::printf("%ld steps: area drift %.2e, volume drift %.2e, Mach %.2g, off the mesh %.3g um at "
              "the start, %.3g um at the end\n",
              *c.run.steps, result.seen.area_drift_max, result.seen.volume_drift_max,
              result.seen.mach_max, result.start * 1e6, result.end * 1e6);
  return result;
}

TEST(StressFreeSphere, ACellRelaxesFromItsBiconcaveShapeWithoutLosingAreaOrVolume) {
  case_::Cell cell;
  cell.stress_free = case_::StressFree::sphere;
  for (const case_::Hinges hinges : {case_::Hinges::rest, case_::Hinges::flat}) {
    cell.hinges = hinges;
    const Outcome result = run(at_rest(cell, 12e-6, 1000), 1);
    EXPECT_EQ(result.seen.cells_end, 1);
    EXPECT_LT(result.seen.area_drift_max, 0.02);    // within 2 %, as asked of a stable start
    EXPECT_LT(result.seen.volume_drift_max, 0.02);  // the same
    EXPECT_GT(result.end, 0.01e-6) << "it is prestressed";
    EXPECT_LT(result.end, 0.5e-6) << "a relaxation, not a collapse: a node spacing";
  }
}

TEST(OtherKinds, PlateletsAndWhiteCellsReturnToTheirShape) {
  for (const case_::CellKind kind : {case_::CellKind::platelet, case_::CellKind::white}) {
    case_::Cell cell = case_::standard_cell(kind);
    if (kind == case_::CellKind::white) cell.vertices = 1442;
    const auto c = at_rest(cell, kind == case_::CellKind::white ? 14e-6 : 6e-6, 1000);
    const Outcome still = run(c, 1);
    // Springs, angles, area and volume are all at rest in the mesh: only round-off moves it, some
    // 1e-16 of 28 nodes a step.
    EXPECT_LT(still.end, 1e-12 * 14e-6);
    // The relaxation time mu R/mu0 is 24 us (platelet) and 95 us (white cell), the runs are 6.8 ms.
    const Outcome stretched = run(c, 1.05);
    EXPECT_EQ(stretched.seen.cells_end, 1);
    EXPECT_LT(stretched.end, 0.1 * stretched.start) << "it returns";
    EXPECT_LT(stretched.seen.area_drift_max, 0.02);
    EXPECT_LT(stretched.seen.volume_drift_max, 0.02);
  }
}

}  // namespace
