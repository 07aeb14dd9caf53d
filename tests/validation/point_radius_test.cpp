// The hydrodynamic radius of a point is what the fluid gives it.
#include <gtest/gtest.h>

#include "support/point_radius.hpp"

namespace {

using namespace hemomag;
using ibm::DeltaKernel;

constexpr int L = 16;
// R of a box of 16 nodes differs from that of 24 and 36 by 2e-4, and numbers have three decimals.
constexpr double box_and_rounding = 1e-3;

solver::FluidParameters fluid_of(DeltaKernel kernel, double tau) {
  solver::FluidParameters p;
  p.relaxation = {tau, 3.0 / 16};
  p.kernel = kernel;
  return p;
}

double radius(DeltaKernel kernel, double tau, const Vec3& offset) {
  const auto p = fluid_of(kernel, tau);
  return test::radius_of_mobility(test::point_mobility(p, L, offset), p.relaxation.viscosity(), L);
}

TEST(PointRadius, AtAQuarterCellIsThatOfAnIndependentProgram) {
  // A NumPy prototype of scheme and coupling that shares no code with this one, L = 24 and 36.
  const Vec3 quarter{0.25, 0.25, 0.25};
  EXPECT_NEAR(radius(DeltaKernel::cosine4, 1, quarter), 1.356, box_and_rounding);
  EXPECT_NEAR(radius(DeltaKernel::roma3, 1, quarter), 1.033, box_and_rounding);
  EXPECT_NEAR(radius(DeltaKernel::linear2, 1, quarter), 0.816, box_and_rounding);
}

TEST(PointRadius, KernelsWithTheSameWeightsShareIt) {
  // On nodes and in cell centres: both four-node kernels (1/4, 1/2, 1/4 on a node), and in the
  // centre both narrow ones (1/2, 1/2).
  constexpr double round_off = 1e-9;  // weights agree to 1e-16, runs take the same steps
  const Vec3 node, centre{0.5, 0.5, 0.5};
  for (const Vec3& at : {node, centre})
    EXPECT_NEAR(radius(DeltaKernel::peskin4, 1, at) / radius(DeltaKernel::cosine4, 1, at), 1,
                round_off);
  EXPECT_NEAR(radius(DeltaKernel::roma3, 1, centre) / radius(DeltaKernel::linear2, 1, centre), 1,
              round_off);
  // On a node a point is smallest, but largest with roma3.
  for (const auto kernel : {DeltaKernel::cosine4, DeltaKernel::linear2})
    EXPECT_LT(radius(kernel, 1, node), radius(kernel, 1, centre));
  EXPECT_GT(radius(DeltaKernel::roma3, 1, node), radius(DeltaKernel::roma3, 1, centre));
}

TEST(PointRadius, DoesNotDependOnViscosity) {
  constexpr double steady = 1e-5;  // velocities are steady to 1e-7, inertia changes less than 1e-5
  for (const auto kernel :
       {DeltaKernel::cosine4, DeltaKernel::peskin4, DeltaKernel::roma3, DeltaKernel::linear2}) {
    const Vec3 somewhere{0.1, 0.35, 0.2};
    EXPECT_NEAR(radius(kernel, 0.7, somewhere) / radius(kernel, 2, somewhere), 1, steady);
  }
}

TEST(PointRadius, OfTheExponentialSchemeIsItsTable) {
  // At one place, where R is near its mean over the cell: one per cent with the
  // four-node kernels, whose R changes with the place by as much, and for the table between points.
  for (const double tau : {0.3, 0.6, 1.0, 2.5}) {
    solver::FluidParameters p;
    p.relaxation = fluid::Relaxation::exponential(tau);
    for (const auto kernel : {DeltaKernel::cosine4, DeltaKernel::peskin4}) {
      p.kernel = kernel;
      const double R = test::radius_of_mobility(test::point_mobility(p, L, {0.25, 0.25, 0.25}),
                                                p.relaxation.viscosity(), L);
      const double expected = ibm::exponential_radius(kernel, tau);
      EXPECT_NEAR(R, expected, 0.01 * expected) << "tau " << tau;
    }
  }
}

TEST(PointRadius, MeanOverTheCellIsTheTable) {
  for (const auto kernel :
       {DeltaKernel::cosine4, DeltaKernel::peskin4, DeltaKernel::roma3, DeltaKernel::linear2}) {
    const auto R = test::point_radius(fluid_of(kernel, 2), L);
    EXPECT_NEAR(R.mean, ibm::hydrodynamic_radius(kernel, 3.0 / 16), box_and_rounding);
    EXPECT_LT(R.min, R.mean);
    EXPECT_GT(R.max, R.mean);
  }
}

}  // namespace
