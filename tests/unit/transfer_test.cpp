// The kernels, and spreading and interpolation on every instruction set.
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "ibm/transfer.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;

TEST(DeltaKernel, CosineIsEquation31) {
  for (double r = 0; r <= 1; r += 1.0 / 512) {
    double w[4];
    ibm::kernel_weights(ibm::DeltaKernel::cosine4, r, w);
    for (int k = 0; k < 4; ++k) {
      const double distance = std::fabs(r - (k - 1));
      EXPECT_NEAR(w[k], 0.25 * (1 + std::cos(std::numbers::pi * distance / 2)), 4e-16) << r;
    }
  }
}

TEST(DeltaKernel, WeightsSumToOneAndPeskinKeepsTheFirstMoment) {
  for (double r = 0; r < 1; r += 1.0 / 512)
    for (const auto kernel : {ibm::DeltaKernel::cosine4, ibm::DeltaKernel::peskin4}) {
      double w[4];
      ibm::kernel_weights(kernel, r, w);
      EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 1, 4e-16);
      const double moment = w[0] * (-1 - r) + w[1] * -r + w[2] * (1 - r) + w[3] * (2 - r);
      if (kernel == ibm::DeltaKernel::peskin4) {
        EXPECT_NEAR(moment, 0, 4e-16);
        EXPECT_NEAR(w[0] + w[2], 0.5, 4e-16) << "even and odd nodes share alike";
      } else {
        EXPECT_LT(std::fabs(moment), 0.022) << "the cosine kernel has it to 2 %";
      }
    }
}

TEST(DeltaKernel, UnknownNamesAreRefused) { EXPECT_THROW(ibm::delta_kernel("cosine5"), Error); }

/// A block of 10 x 9 x 8 nodes with three halo layers, and points all over it.
struct Grid {
  lattice::NodeLayout layout{{10, 9, 8}, 3, 8};
  std::vector<double> storage = std::vector<double>(3 * layout.count, 0.0);
  std::vector<Vec3> x;
  std::vector<int> mask;
  std::array<double*, 3> at;

  Grid() {
    for (std::size_t d = 0; d < 3; ++d) at[d] = storage.data() + d * layout.count + layout.origin;
    test::Random random(21);
    for (int k = 0; k < 200; ++k) {
      x.push_back({random.uniform(20, 30), random.uniform(-4, 5), random.uniform(0, 8)});
      mask.push_back(k % 3 == 0 ? 2 : 1);
    }
  }
  static constexpr std::array<double, 3> begin{20, -4, 0};
};

TEST(Transfer, SpreadAndInterpolateAreAdjointAndConserveForceOnEverySimdLevel) {
  test::Random random(22);
  Grid field;
  for (double& v : field.storage) v = random.uniform(-1, 1);
  std::vector<Vec3> f;
  for (std::size_t k = 0; k < field.x.size(); ++k) f.push_back(random.in_cube(1));

  std::vector<Vec3> reference_u;
  std::vector<double> reference_force;
  for (const auto level : {SimdLevel::sse2, SimdLevel::avx2, SimdLevel::avx512}) {
    if (level > simd_level()) continue;
    for (const auto kernel : {ibm::DeltaKernel::cosine4, ibm::DeltaKernel::peskin4}) {
      std::vector<Vec3> u(field.x.size());
      const ibm::Selection some{field.mask, 1, 0};
      ASSERT_EQ(ibm::interpolate(kernel, {{field.at[0], field.at[1], field.at[2]}, field.layout, Grid::begin}, field.x, some, u, level), -1);
      Grid force;
      ASSERT_EQ(ibm::spread(kernel, {force.at, force.layout, Grid::begin}, field.x, some, f, level), -1);
      double power_points = 0, power_nodes = 0;
      Vec3 spread, given;
      for (std::size_t k = 0; k < f.size(); ++k)
        if (field.mask[k] == 1) power_points += dot(f[k], u[k]), given += f[k];
      for (std::size_t n = 0; n < force.storage.size(); ++n) {
        power_nodes += force.storage[n] * field.storage[n];
        spread[n / force.layout.count] += force.storage[n];
      }
      EXPECT_NEAR(power_points, power_nodes, 1e-12);
      EXPECT_LT(norm(spread - given), 1e-12);
      if (kernel != ibm::DeltaKernel::cosine4) continue;
      if (reference_u.empty()) reference_u = u, reference_force = force.storage;
      constexpr double round_off = 64 * 2.2e-16;  // 64 products of values below one
      for (std::size_t k = 0; k < u.size(); ++k) EXPECT_LT(norm(u[k] - reference_u[k]), round_off);
      for (std::size_t n = 0; n < force.storage.size(); ++n) EXPECT_NEAR(force.storage[n], reference_force[n], round_off);
    }
  }
}

TEST(Transfer, APointOutsideTheHaloOrNotFiniteIsReported) {
  Grid grid;
  std::vector<Vec3> u(grid.x.size());
  for (const Vec3& bad : {Vec3{36, 0, 4}, Vec3{25, 0, NAN}, Vec3{1e300, 0, 0}}) {
    auto x = grid.x;
    x[7] = bad;
    EXPECT_EQ(ibm::interpolate(ibm::DeltaKernel::cosine4, {{grid.at[0], grid.at[1], grid.at[2]}, grid.layout, Grid::begin}, x,
                               {grid.mask, 3, 0}, u, simd_level()),
              7);
  }
}

}  // namespace
