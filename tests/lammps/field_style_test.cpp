// fix hemo/field in a script: forces, moments and energy are those of the fields at the time of the
// step.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "atom.h"
#include "lammps.h"
#include "modify.h"

#include "lammps/compat.hpp"
#include "lammps/fix_hemo_field.h"
#include "lammps/host.hpp"
#include "magnetic/field.hpp"
#include "magnetic/moment.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;

/// Atoms of one type at rest, whose forces of the last of `steps` steps are the field's alone.
void run(lammps::Host& host, const std::string& words, int steps) {
  for (const std::string line :
       {"units lj", "atom_style molecular", "boundary p p p", "region b block 0 16 0 16 0 16",
        "create_box 1 b", "create_atoms 1 random 40 7 b", "mass * 1", "pair_style zero 1.0",
        "pair_coeff * *", "neighbor 1.0 bin", "timestep 1.0"})
    host.command(line);
  host.command("fix field all hemo/field susceptibility 1 0.3 " + words);
  host.command("run " + std::to_string(steps));
}

/// Largest difference of the forces and moments of all atoms from what `field` and `law` say.
double difference(lammps::Host& host, const magnetic::Field& field,
                  const magnetic::Magnetisation& law) {
  auto* atom = host.lammps().atom;
  auto* fix = lammps::find_fix<LAMMPS_NS::FixHemoField>(&host.lammps(), "hemo/field");
  double worst = 0, energy = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    const auto at = field({atom->x[i][0], atom->x[i][1], atom->x[i][2]});
    const Vec3 m = law.moment(at.B), F = magnetic::gradient_force(m, at);
    const Vec3 f{atom->f[i][0], atom->f[i][1], atom->f[i][2]};
    const double* moment = fix->moments()[i];
    worst = std::max({worst, norm(f - F), norm(Vec3{moment[0], moment[1], moment[2]} - m)});
    energy += law.energy(at.B);
  }
  double all[2] = {0, 0};
  MPI_Allreduce(&worst, &all[0], 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  MPI_Allreduce(&energy, &all[1], 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return std::max(all[0], std::fabs(all[1] - fix->compute_scalar()));
}

TEST(FieldStyle, AMagnetAndALoopPullSaturatedMoments) {
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD);
  run(host, "saturation 1 0.05 cylinder 1.2 6 4 8 8 -4 0 0 1 coil -0.7 30 8 8 8 0 1 0", 3);
  const auto up = magnetic::Frame::along({8, 8, -4}, {0, 0, 1});
  const auto around = magnetic::Frame::along({8, 8, 8}, {0, 1, 0});
  const magnetic::Field field({{magnetic::CylinderMagnet{up, 3, 2, 1.2}, {}},
                               {magnetic::CurrentLoop{around, 15, -0.7}, {}}});
  EXPECT_LT(difference(host, field, {0.3, 0.05}), 1e-14);
}

TEST(FieldStyle, ARotatingFieldIsThatOfTheStep) {
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD);
  run(host, "rotating yz 0.8 0.02 quadrupole zx 0.01 8 8 8 ramp 0 10", 7);
  const double angle = 2 * std::numbers::pi * 0.02 * 7;
  magnetic::UniformField turned{{0, 0.8 * std::cos(angle), 0.8 * std::sin(angle)}};
  const magnetic::Field field({{turned, {}}, {magnetic::Quadrupole{2, 0, 0.007, {8, 8, 8}}, {}}});
  EXPECT_LT(difference(host, field, {0.3, 0}), 1e-14);
}

}  // namespace
