// One carrier pulled through fluid between plates by the field's gradient moves as a sphere of its
// radius should.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "atom.h"
#include "lammps.h"

#include "base/vec3.hpp"
#include "lammps/host.hpp"

namespace {

using hemomag::lammps::Host;

constexpr double H = 48;         // 24 um at dx = 0.5 um
constexpr double radius = 0.25;  // 125 nm
constexpr double T_e = 15300;    // steps, B0 = 0.1 T at the demo's time step

/// Speed towards the lower plate over Stokes' at the place where the carrier is after 3,000 steps.
std::pair<double, double> drift(double start, const std::string& feedback) {
  Host host({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD);
  const double eta = 1.0 / 6, G = 1 / H;
  const double chi_volume = 6 * std::numbers::pi * eta * radius / (T_e * G * G);
  for (const std::string& line :
       {std::string("units lj"), std::string("atom_style molecular"), std::string("newton on"),
        std::string("boundary p p f"), std::string("region box block 0 32 0 32 0 48"),
        std::string("create_box 1 box"), "create_atoms 1 single 16.3 15.9 " + std::to_string(start),
        std::string("mass * 1"), std::string("neighbor 1.0 bin"),
        std::string("neigh_modify every 1 delay 0 check yes"),
        std::string("pair_style hemo/dipole 3.0"), std::string("pair_coeff * * 0.5 soft 30"),
        std::string("fix drag all hemo/drag radius 1 0.25 feedback ") + feedback,
        "fix field all hemo/field susceptibility 1 " + std::to_string(chi_volume) + " gradient z " +
            std::to_string(G) + " 48",
        std::string("fix fluid all hemo/fluid tau 1.0 plates z lower 0 0 0 upper 0 0 0"),
        std::string("timestep 1.0"), std::string("run 3000")})
    host.command(line);
  auto* atom = host.lammps().atom;
  double mine[2] = {0, 0}, all[2];
  if (atom->nlocal == 1) {
    // v is the velocity of the last move, made from the place before it.
    mine[0] = atom->x[0][2] - atom->v[0][2];
    mine[1] = -atom->v[0][2] /
              ((H - mine[0]) * std::round(chi_volume * 1e6) / 1e6 *
               std::pow(std::round(G * 1e6) / 1e6, 2) / (6 * std::numbers::pi * eta * radius));
  }
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return {all[0], all[1]};
}

void expect(double start, double slit_factor) {
  const auto [z, ratio] = drift(start, "yes");
  const double tolerance =
      0.005;  // prototype within 0.1 %, slit factor from an exact Green function
  std::printf("z %.2f um: speed over Stokes %.4f expected %.4f error %.4f tolerance %.3f\n", z / 2,
              ratio, slit_factor, std::fabs(ratio / slit_factor - 1), tolerance);
  EXPECT_NEAR(ratio / slit_factor, 1, tolerance);
}

// 1 - c a with c = 0.1845 /um at mid-channel and 0.1886 /um at 9 um, lateral box 16 x 16 um.
TEST(CarrierDrift, MatchesTheSlitFactorAtMidChannel) { expect(28.2, 1 - 0.1845 * 0.125); }
TEST(CarrierDrift, MatchesTheSlitFactorAtNineMicrometres) { expect(23.2, 1 - 0.1886 * 0.125); }

TEST(CarrierDrift, OneWayCouplingIsStokesExactly) {
  const auto [z, ratio] = drift(28.2, "no");
  EXPECT_NEAR(ratio, 1, 1e-9) << "at " << z;
}

}  // namespace
