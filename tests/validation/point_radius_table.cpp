// Measures every number of ibm::hydrodynamic_radius again, and what lies between: six minutes.
//   build/tests/point_radius_table
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "support/point_radius.hpp"

namespace {

using namespace hemomag;

constexpr const char* kernels[] = {"cosine4", "peskin4", "roma3", "linear2"};

/// Print a line of the table. @return mean R over R of the library
double measured_over_table(const char* name, double root, int L) {
  solver::FluidParameters p;
  // R does not depend on tau: take what becomes steady soonest. At small Lambda odd moments are
  // nearly undamped, the less the larger tau is.
  p.relaxation = {root < 0.1 ? 1.0 : 2.0, root * root};
  p.kernel = ibm::delta_kernel(name);
  const auto R = test::point_radius(p, L);
  const double table = ibm::hydrodynamic_radius(p.kernel, root * root);
  std::printf("%-8s sqrt(Lambda) %.6f L %d: R %.4f (%.4f to %.4f) table %.4f\n", name, root, L,
              R.mean, R.min, R.max, table);
  std::fflush(stdout);
  return R.mean / table;
}

TEST(PointRadiusTable, IsMeasured) {
  constexpr double rounding = 2.5e-3;  // half a unit of the third decimal at R = 0.219
  for (const char* name : kernels)
    for (const double root :
         {0.02, 0.05, 0.1, 0.2, 0.3, std::sqrt(3.0) / 4, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0})
      EXPECT_NEAR(measured_over_table(name, root, 24), 1, rounding);
}

TEST(PointRadiusTable, MobilityIsLinearBetween) {
  constexpr double documented = 0.005;
  for (const char* name : kernels)
    for (const double root : {0.03, 0.07, 0.15, 0.25, 0.365, 0.625, 0.875, 1.25, 1.75, 2.5})
      EXPECT_NEAR(measured_over_table(name, root, 24), 1, documented);
}

TEST(PointRadiusTable, BoxIsLargeEnough) {
  constexpr double rounding = 1e-3;  // half a unit of the third decimal, and 1e-4 of the box
  for (const char* name : kernels)
    EXPECT_NEAR(measured_over_table(name, std::sqrt(3.0) / 4, 36), 1, rounding);
}

}  // namespace
