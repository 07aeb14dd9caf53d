// Carriers with inertia, and chains of touching carriers, in fluid: known motion, conserved
// momentum, stability at the number of sub-steps that the fix chooses.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lammps/compat.hpp"
#include "lammps/fix_hemo_drag.h"
#include "lammps/fix_hemo_fluid.h"
#include "lammps/host.hpp"
#include "lammps/positions.hpp"
#include "magnetic/dipole.hpp"
#include "solver/fluid_solver.hpp"

namespace {

using namespace hemomag;

constexpr double a = 0.4, eta = 1.0 / 6;
const double stokes = 6 * std::numbers::pi * eta * a;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// Carriers of one type in a periodic box of 24 nodes.
void start(lammps::Host& host, const std::vector<Vec3>& x, const std::string& pair,
           const std::string& drag, const std::vector<std::string>& fixes) {
  for (const char* line : {"units lj", "atom_style molecular", "newton on", "boundary p p p",
                           "region box block 0 24 0 24 0 24", "create_box 1 box"})
    host.command(line);
  for (const Vec3& p : x)
    host.command("create_atoms 1 single " + number(p.x) + " " + number(p.y) + " " + number(p.z));
  host.command("mass * 1");
  host.command("neighbor 1.0 bin");
  host.command("neigh_modify every 1 delay 0 check yes");
  host.command(pair);
  host.command(pair.rfind("pair_style zero", 0) == 0 ? "pair_coeff * *"
                                                     : "pair_coeff * * 0.8 soft 60");
  host.command("fix drag all hemo/drag " + drag);
  for (const auto& line : fixes) host.command(line);
  host.command("fix fluid all hemo/fluid tau 1");
  host.command("timestep 1.0");
}

TEST(CarrierInertia, OneWayItRelaxesExponentiallyAcrossBorders) {
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD);
  constexpr double time = 12, force = 1e-2;
  start(host, {{11.9, 12.1, 11.8}}, "pair_style zero 1.0",
        "feedback no radius 1 0.4 inertia 1 " + number(time * stokes),
        {"fix pull all addforce " + number(force) + " 0 0"});
  host.command("velocity all set 0 0.3 -0.2");
  constexpr int steps = 30;
  host.command("run " + std::to_string(steps));
  const Vec3 v = lammps::velocities(host.lammps())[0], x = lammps::positions(host.lammps())[0];
  const double left = std::exp(-steps / time), end = force / stokes;
  constexpr double round_off = 1e-12;  // some roundings a step
  EXPECT_NEAR(v.x, end * (1 - left), round_off);
  EXPECT_NEAR(v.y, 0.3 * left, round_off);
  EXPECT_NEAR(v.z, -0.2 * left, round_off);
  EXPECT_NEAR(x.x, 11.9 + end * (steps - time * (1 - left)), round_off * steps);
  EXPECT_NEAR(x.y, 12.1 + 0.3 * time * (1 - left), round_off * steps);
}

TEST(CarrierInertia, MomentumGoesToTheFluidAndIsConserved) {
  // Two carriers that attract one another, with inertia and sub-steps: nothing pulls from outside.
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD);
  const double mass = 20 * stokes;
  start(host, {{11.9, 12.1, 11.8}, {11.9, 12.2, 12.7}}, "pair_style hemo/dipole 3.0",
        "radius 1 0.4 inertia 1 " + number(mass),
        {"fix field all hemo/field susceptibility 1 1 uniform 0 0 0.25"});
  const Vec3 v0{1e-3, -2e-3, 5e-4};
  host.command("velocity all set " + number(v0.x) + " " + number(v0.y) + " " + number(v0.z));
  host.command("run 300");
  auto& lmp = host.lammps();
  EXPECT_GT(lammps::find_fix<LAMMPS_NS::FixHemoDrag>(&lmp, "hemo/drag")->substeps(), 1);
  const Vec3 mine =
      lammps::find_fix<LAMMPS_NS::FixHemoFluid>(&lmp, "hemo/fluid")->solver().momentum();
  Vec3 total;
  MPI_Allreduce(&mine.x, &total.x, 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  const auto v = lammps::velocities(lmp);
  total += mass * (v[0] + v[1]);
  constexpr double round_off = 1e-12;  // relative to what there was
  EXPECT_LT(norm(total - 2 * mass * v0), round_off * norm(2 * mass * v0));
  EXPECT_LT(norm(v[0]), norm(v0)) << "the fluid has taken some";
  const auto x = lammps::positions(lmp);
  EXPECT_NEAR(norm(x[1] - x[0]), 0.8, 0.01) << "and they touch";
}

/// A straight chain in line with a field whose contacts have the rate k dt/Gamma, after 300 steps:
/// largest difference of neighbouring bonds over the diameter.
double unrest(double radius, double rate) {
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD);
  const double R = 1.356, d = 2 * radius;
  const double bare = 6 * std::numbers::pi * eta * radius / (1 - radius / R);
  const double pull = rate * bare * d / (magnetic::chain_load * 60 - 4);
  const double moment = std::sqrt(pull * std::numbers::pi * std::pow(d, 4) / 1.5);
  std::vector<Vec3> x;
  for (int k = 0; k < 11; ++k)
    x.push_back({12.2, 12.1 + 1e-4 * std::sin(7.1 * k), 12.3 + d * (k - 5)});
  for (const char* line : {"units lj", "atom_style molecular", "newton on", "boundary p p p",
                           "region box block 0 24 0 24 0 24", "create_box 1 box"})
    host.command(line);
  for (const Vec3& p : x)
    host.command("create_atoms 1 single " + number(p.x) + " " + number(p.y) + " " + number(p.z));
  for (const std::string& line :
       {std::string("mass * 1"), std::string("neighbor 1.0 bin"),
        std::string("neigh_modify every 1 delay 0 check yes"),
        std::string("pair_style hemo/dipole 10.0"), "pair_coeff * * " + number(d) + " soft 60",
        "fix drag all hemo/drag radius 1 " + number(radius),
        "fix field all hemo/field susceptibility 1 1 uniform 0 0 " + number(moment),
        std::string("fix fluid all hemo/fluid tau 1.5"), std::string("timestep 1.0"),
        std::string("run 300")})
    host.command(line);
  x = lammps::positions(host.lammps());
  double worst = 0;
  for (std::size_t k = 2; k < x.size(); ++k)
    worst = std::max(worst, std::fabs(norm(x[k] - x[k - 1]) - norm(x[k - 1] - x[k - 2])));
  return worst / d;
}

TEST(CarrierInertia, ALongChainAtRestStaysStraightAtTheChosenSubSteps) {
  // Just below the rates at which one more sub-step is taken. Radius one node leaves three quarters
  // of the mobility to the fluid, which answers a step late.
  for (const double radius : {0.25, 1.0})
    for (const double rate : {0.24, 0.49, 0.99, 1.49}) {
      const double worst = unrest(radius, rate);
      std::printf("a %.2f, rate %.2f: neighbouring bonds differ by up to %.4f diameters\n", radius,
                  rate, worst);
      EXPECT_LT(worst, 0.005) << "the load of the ends differs from the middle's by 0.2 kappa^-1";
    }
}

}  // namespace
