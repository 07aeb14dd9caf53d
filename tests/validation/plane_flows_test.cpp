// Flows with exact solutions: measured, expected, error and tolerance are printed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/fluid_solver.hpp"
#include "support/grid.hpp"

namespace {

using hemomag::Vec3;
using hemomag::solver::FluidParameters;
using hemomag::solver::FluidSolver;

std::vector<Vec3> velocity(FluidSolver& fluid) {
  std::vector<double> rho(fluid.block().owned());
  std::vector<Vec3> u(rho.size());
  fluid.copy_owned(rho, u);
  return u;
}

void report(const char* what, double measured, double expected, double tolerance) {
  std::printf("%-40s measured %.10g expected %.10g error %.2e tolerance %.1e\n", what, measured,
              expected, std::fabs(measured - expected), tolerance);
}

constexpr double plane_flow =
    1e-10;  // relative to the largest velocity: exact up to accumulated rounding

TEST(PlaneFlow, CouetteFromRestIsExact) {
  for (const double tau : {0.7, 1.0, 1.5}) {
    const std::array<int, 3> n{8, 4, 16};
    const double U = 0.05;
    FluidParameters p;
    p.relaxation.tau = tau;
    p.plate_axis = 2;
    p.plate_velocity[1] = {0, U, 0};
    FluidSolver fluid(hemomag::test::neighbourhood(n, 2), p);
    fluid.initialise(
        [](const Vec3&) { return std::pair<Vec3, hemomag::fluid::VelocityGradient>{}; });
    const int steps = static_cast<int>(30 * n[2] * n[2] / (9.8 * p.relaxation.viscosity()));
    for (int t = 0; t < steps; ++t) fluid.step();
    double worst = 0;
    const auto u = velocity(fluid);
    for (std::size_t k = 0; k < u.size(); ++k) {
      const double z = static_cast<double>(k / (8 * 4)) + 0.5;
      worst = std::max(worst, norm(u[k] - Vec3{0, U * z / n[2], 0}));
    }
    report("Couette, largest error over U", worst / U, 0, plane_flow);
    EXPECT_LT(worst / U, plane_flow) << "tau " << tau;
  }
}

TEST(PlaneFlow, CouetteStartsWithoutTransient) {
  const std::array<int, 3> n{8, 4, 16};
  FluidParameters p;
  p.plate_axis = 2;
  p.plate_velocity = {Vec3{0, -0.03, 0}, Vec3{0, 0.03, 0}};
  FluidSolver fluid(hemomag::test::neighbourhood(n, 2), p);
  const double shear = 0.06 / n[2];
  fluid.initialise([&](const Vec3& x) {
    std::pair<Vec3, hemomag::fluid::VelocityGradient> flow;
    flow.first = {0, -0.03 + shear * x.z, 0};
    flow.second[2] = {0, shear, 0};
    return flow;
  });
  double worst = 0;
  for (int t = 0; t < 100; ++t) {
    fluid.step();
    const auto u = velocity(fluid);
    for (std::size_t k = 0; k < u.size(); ++k)
      worst = std::max(
          worst, norm(u[k] - Vec3{0, -0.03 + shear * (static_cast<double>(k / 32) + 0.5), 0}));
  }
  report("Couette from its own profile, error over U", worst / 0.03, 0, plane_flow);
  EXPECT_LT(worst / 0.03, plane_flow);
}

TEST(PlaneFlow, PoiseuilleIsExact) {
  for (const double tau : {0.55, 1.0, 2.0}) {
    const std::array<int, 3> n{8, 4, 12};
    FluidParameters p;
    p.relaxation.tau = tau;
    p.plate_axis = 2;
    const double nu = p.relaxation.viscosity(), peak = 0.02, H = n[2];
    p.relaxation.force[1] = 8 * nu * peak / (H * H);
    FluidSolver fluid(hemomag::test::neighbourhood(n, 2), p);
    fluid.initialise(
        [](const Vec3&) { return std::pair<Vec3, hemomag::fluid::VelocityGradient>{}; });
    const int steps = static_cast<int>(30 * H * H / (9.8 * nu));
    for (int t = 0; t < steps; ++t) fluid.step();
    double worst = 0;
    const auto u = velocity(fluid);
    for (std::size_t k = 0; k < u.size(); ++k) {
      const double z = static_cast<double>(k / 32) + 0.5;
      worst =
          std::max(worst, norm(u[k] - Vec3{0, p.relaxation.force[1] * z * (H - z) / (2 * nu), 0}));
    }
    report("Poiseuille, largest error over peak", worst / peak, 0, plane_flow);
    EXPECT_LT(worst / peak, plane_flow) << "tau " << tau;
  }
}

/// Viscosity over (tau - 1/2)/3 from the decay of a transverse wave of wavelength L between t and 2
/// t.
double shear_wave_viscosity(int L, double tau) {
  const double k = 2 * std::numbers::pi / L;
  FluidParameters p;
  p.relaxation.tau = tau;
  FluidSolver fluid(hemomag::test::neighbourhood({L, 4, 4}, -1), p);
  fluid.initialise([&](const Vec3& x) {
    std::pair<Vec3, hemomag::fluid::VelocityGradient> flow;
    flow.first = {0, 1e-4 * std::sin(k * x.x), 0};
    flow.second[0] = {0, 1e-4 * k * std::cos(k * x.x), 0};
    return flow;
  });
  const auto amplitude = [&] {
    double a = 0;
    const auto u = velocity(fluid);
    for (int x = 0; x < L; ++x)
      a += u[static_cast<std::size_t>(x)].y * std::sin(k * (x + 0.5)) * 2 / L;
    return a;
  };
  const int t = static_cast<int>(1.0 / (fluid.viscosity() * k * k));
  for (int s = 0; s < t; ++s) fluid.step();
  const double early = amplitude();
  for (int s = 0; s < t; ++s) fluid.step();
  return std::log(early / amplitude()) / (k * k * t) / fluid.viscosity();
}

TEST(ShearWave, ViscosityConvergesAtSecondOrder) {
  const double at32 = shear_wave_viscosity(32, 1.0), at64 = shear_wave_viscosity(64, 1.0);
  report("shear wave, L = 32", at32, 1, 2e-3);
  report("shear wave, L = 64", at64, 1, 5e-4);
  const double slope = std::log2((at32 - 1) / (at64 - 1));
  report("shear wave, order of convergence", slope, 2, 0.1);
  EXPECT_NEAR(at32, 1, 2e-3);
  EXPECT_NEAR(at64, 1, 5e-4);
  EXPECT_NEAR(slope, 2, 0.1);
}

}  // namespace
