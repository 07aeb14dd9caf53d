// fix hemo/contact through LAMMPS: forces against the pure law on one process, no net force, energy
// and its gradient, and the same run on any number of ranks.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <mpi.h>

#include "case/lattice_units.hpp"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_contact.h"
#include "lammps/fix_hemo_watch.h"
#include "lattice/triangle_distance.hpp"
#include "support/small_case.hpp"

namespace {

using namespace hemomag;

constexpr double rank_tolerance = 1e-12;  // of the largest force or of the box, over 20 steps

case_::Case near_cells(long steps) {
  case_::Case c = test::small_case();
  c.contact.carrier_contact = case_::CarrierContact::surface;
  c.run.steps = steps;
  return c;
}

/// Every carrier half the range in front of a triangle of a cell.
case_::System touching(const case_::Case& c) {
  auto system = case_::place(c);
  for (std::size_t k = 0; k < system.carriers.size(); ++k) {
    const auto& cell = system.cells[k % system.cells.size()];
    const auto& triangles = system.models[cell.model].mesh.triangles;
    const auto& t = triangles[(97 * k + 31) % triangles.size()];
    const Vec3 a = cell.x[std::size_t(t[0])], b = cell.x[std::size_t(t[1])],
               d = cell.x[std::size_t(t[2])];
    const Vec3 normal = cross(b - a, d - a);
    system.carriers[k].beads[0] =
        (1. / 3) * (a + b + d) + (0.5 * c.contact.surface_range / norm(normal)) * normal;
  }
  return system;
}

struct Touched {
  test::State state;
  double energy = 0;
  LAMMPS_NS::bigint inside = 0;
};

Touched run(MPI_Comm comm, const case_::Case& c, const case_::System& system) {
  Touched t;
  t.state = test::run_case_on(comm, c, system, [&](lammps::Host& host) {
    t.energy = lammps::find_fix<LAMMPS_NS::FixHemoContact>(&host.lammps(), "hemo/contact")
                   ->compute_scalar();
    t.inside = lammps::find_fix<LAMMPS_NS::FixHemoWatch>(&host.lammps(), "hemo/watch")
                   ->record()
                   .carriers_inside_max;
  });
  return t;
}

/// Energy of all contacts of a starting state, triangle by triangle, in lattice units.
double energy_of(const case_::Case& c, const case_::System& system) {
  const auto units = case_::lattice_units(c);
  const contact::SurfaceBarrier barrier{c.contact.surface_stiffness / units.tension(),
                                        c.contact.surface_range / units.dx};
  double energy = 0;
  for (const auto& carrier : system.carriers)
    for (const auto& cell : system.cells)
      for (const auto& t : system.models[cell.model].mesh.triangles)
        for (int i = -1; i <= 1; ++i)
          for (int j = -1; j <= 1; ++j) {
            const Vec3 shift{i * c.channel.size[0], j * c.channel.size[1], 0};
            const auto corner = [&](std::size_t k) {
              return (1 / units.dx) * (cell.x[std::size_t(t[k])] + shift);
            };
            energy += contact::barrier_forces(barrier, (1 / units.dx) * carrier.beads[0],
                                              {corner(0), corner(1), corner(2)})
                          .energy;
          }
  return energy;
}

TEST(SurfaceContact, HasTheEnergyOfEveryTriangleOnce) {
  const auto c = near_cells(0);
  const auto system = touching(c);
  const double expected = energy_of(c, system);
  ASSERT_GT(expected, 0);
  constexpr double digits = 1e-8;  // scripts write range and stiffness with nine digits
  EXPECT_NEAR(run(MPI_COMM_WORLD, c, system).energy, expected, digits * expected);
}

TEST(SurfaceContact, IsTheSameOnAnyNumberOfRanks) {
  const auto c = near_cells(20);
  const auto system = touching(c);
  const Touched alone = run(MPI_COMM_SELF, c, system), here = run(MPI_COMM_WORLD, c, system);
  EXPECT_EQ(here.inside, 0);
  EXPECT_NEAR(here.energy, alone.energy, 1e-9 * alone.energy);
  double largest = 0;
  for (const Vec3& f : alone.state.f) largest = std::max(largest, norm(f));
  for (std::size_t k = 0; k < alone.state.x.size(); ++k) {
    EXPECT_LT(norm(here.state.x[k] - alone.state.x[k]), rank_tolerance * 28) << k;
    EXPECT_LT(norm(here.state.f[k] - alone.state.f[k]), 100 * rank_tolerance * largest) << k;
  }
}

}  // namespace
