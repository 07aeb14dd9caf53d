// The kernels, and spreading and interpolation on every instruction set and in both precisions.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ibm/transfer.hpp"
#include "reference/transfer_reference.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;
using ibm::DeltaKernel;

constexpr DeltaKernel kernels[] = {DeltaKernel::cosine4, DeltaKernel::peskin4, DeltaKernel::roma3,
                                   DeltaKernel::linear2};
constexpr double eps = std::numeric_limits<double>::epsilon();

/// For every kernel and 512 places between two nodes: check(kernel, r, weights).
template <class Check> void for_all_weights(Check check) {
  for (const DeltaKernel kernel : kernels)
    for (double r = 0; r < 1; r += 1.0 / 512) {
      double w[4];
      ibm::kernel_weights(kernel, r, w);
      check(kernel, r, w);
    }
}

TEST(DeltaKernel, WeightsAreThePublishedFunctions) {
  for_all_weights([](DeltaKernel kernel, double r, const double(&w)[4]) {
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(w[k], reference::delta(kernel, r - (k - 1)), 2 * eps)
          << static_cast<int>(kernel) << " at " << r;
  });
}

TEST(DeltaKernel, WeightsSumToOne) {
  for_all_weights([](DeltaKernel kernel, double r, const double(&w)[4]) {
    EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 1, 2 * eps) << static_cast<int>(kernel) << " at " << r;
  });
}

TEST(DeltaKernel, FirstMomentVanishesButForTheCosine) {
  for_all_weights([](DeltaKernel kernel, double r, const double(&w)[4]) {
    const double moment = w[0] * (-1 - r) + w[1] * -r + w[2] * (1 - r) + w[3] * (2 - r);
    if (kernel == DeltaKernel::cosine4)
      EXPECT_LT(std::fabs(moment), 0.022) << "the cosine kernel has it to 2 %";
    else
      EXPECT_NEAR(moment, 0, 2 * eps) << static_cast<int>(kernel) << " at " << r;
  });
}

TEST(DeltaKernel, EvenAndOddNodesShareAlikeInFourNodeKernels) {
  for_all_weights([](DeltaKernel kernel, double, const double(&w)[4]) {
    if (kernel != DeltaKernel::cosine4 && kernel != DeltaKernel::peskin4) return;
    EXPECT_NEAR(w[0] + w[2], 0.5, 2 * eps);
  });
}

TEST(DeltaKernel, UnknownNamesAreRefusedWithTheAcceptedOnes) {
  EXPECT_EQ(ibm::delta_kernel("roma3"), DeltaKernel::roma3);
  EXPECT_EQ(ibm::delta_kernel("linear2"), DeltaKernel::linear2);
  try {
    ibm::delta_kernel("cosine5");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("accepted: cosine4, peskin4, roma3, linear2"),
              std::string::npos);
  }
}

TEST(HydrodynamicRadius, FallsWithLambdaAndStaysAboveZero) {
  for (const DeltaKernel kernel : kernels) {
    double before = 2;
    for (double root = 0.01; root < 100; root *= 1.1) {
      const double R = ibm::hydrodynamic_radius(kernel, root * root);
      EXPECT_LT(R, before);
      EXPECT_GT(R, 0);
      before = R;
    }
  }
}

/// A block of 10 x 9 x 8 nodes with three halo layers, and points all over it.
template <class T> struct Grid {
  lattice::NodeLayout layout{{10, 9, 8}, 3, 64 / sizeof(T)};
  std::vector<T> storage = std::vector<T>(3 * layout.count, T(0));
  std::array<T*, 3> at;
  std::vector<Vec3> x;
  std::vector<int> mask;

  Grid() {
    for (std::size_t d = 0; d < 3; ++d) at[d] = storage.data() + d * layout.count + layout.origin;
    test::Random random(21);
    for (int k = 0; k < 200; ++k) {
      x.push_back({random.uniform(20, 30), random.uniform(-4, 5), random.uniform(0, 8)});
      mask.push_back(k % 3 == 0 ? 2 : 1);
    }
  }
  ibm::NodeVectorView<const T> read() const { return {{at[0], at[1], at[2]}, layout, begin}; }
  ibm::NodeVectorView<T> write() const { return {at, layout, begin}; }

  /// The reference's sum for every point of mask 1: visit(point, offset of node, weight).
  template <class Visit> void for_each_weight(DeltaKernel kernel, Visit visit) const {
    for (std::size_t v = 0; v < x.size(); ++v) {
      if (mask[v] != 1) continue;
      const Vec3 own{x[v].x - begin[0] - 0.5, x[v].y - begin[1] - 0.5, x[v].z - begin[2] - 0.5};
      reference::for_each_weight(kernel, own, [&](const std::array<int, 3>& n, double weight) {
        visit(v, layout.index(n[0], n[1], n[2]), weight);
      });
    }
  }
  static constexpr std::array<double, 3> begin{20, -4, 0};
};

template <class T> struct Transfer : testing::Test {
  // 64 products of values below one; some twenty points add to a node.
  static constexpr double round_off = 64 * std::numeric_limits<T>::epsilon();

  Grid<T> field;
  std::vector<Vec3> f;
  double scale = 0;  // sum of |f| over the points taken

  Transfer() {
    test::Random random(22);
    for (T& v : field.storage) v = static_cast<T>(random.uniform(-1, 1));
    for (const int mask : field.mask) {
      f.push_back(random.in_cube(1));
      if (mask == 1) scale += norm(f.back());
    }
  }
  ibm::Selection some() const { return {field.mask, 1, 0}; }
  std::vector<Vec3> interpolated(DeltaKernel kernel, SimdLevel level) const {
    std::vector<Vec3> u(field.x.size());
    EXPECT_EQ(ibm::interpolate(kernel, field.read(), field.x, some(), u, level), -1);
    return u;
  }
  Grid<T> spread(DeltaKernel kernel, SimdLevel level) const {
    Grid<T> force;
    EXPECT_EQ(ibm::spread(kernel, force.write(), force.x, some(), f, level), -1);
    return force;
  }
};
using NodeTypes = testing::Types<double, float>;
TYPED_TEST_SUITE(Transfer, NodeTypes);

/// Every kernel on every instruction set this processor has: check(kernel, level).
template <class Check> void for_all(Check check) {
  for (const auto level : {SimdLevel::sse2, SimdLevel::avx2, SimdLevel::avx512})
    for (const DeltaKernel kernel : kernels) {
      if (level > simd_level()) continue;
      SCOPED_TRACE(std::string(name(level)) + ", kernel " +
                   std::to_string(static_cast<int>(kernel)));
      check(kernel, level);
    }
}

TYPED_TEST(Transfer, InterpolationIsTheReference) {
  for_all([&](DeltaKernel kernel, SimdLevel level) {
    const auto u = this->interpolated(kernel, level);
    std::vector<Vec3> expected(u.size());
    this->field.for_each_weight(kernel, [&](std::size_t v, std::ptrdiff_t n, double weight) {
      for (std::size_t d = 0; d < 3; ++d) expected[v][d] += weight * this->field.at[d][n];
    });
    // Float nodes are widened exactly: the sums are double for both.
    for (std::size_t v = 0; v < u.size(); ++v) EXPECT_LT(norm(u[v] - expected[v]), 64 * eps);
  });
}

TYPED_TEST(Transfer, SpreadingIsTheReference) {
  for_all([&](DeltaKernel kernel, SimdLevel level) {
    const Grid<TypeParam> force = this->spread(kernel, level);
    std::vector<double> sum(force.storage.size(), 0.0);
    force.for_each_weight(kernel, [&](std::size_t v, std::ptrdiff_t n, double weight) {
      for (std::size_t d = 0; d < 3; ++d)
        sum[static_cast<std::size_t>(force.at[d] + n - force.storage.data())] +=
            weight * this->f[v][d];
    });
    for (std::size_t k = 0; k < sum.size(); ++k)
      EXPECT_NEAR(force.storage[k], sum[k], this->round_off);
  });
}

TYPED_TEST(Transfer, SpreadingIsAdjointToInterpolation) {
  for_all([&](DeltaKernel kernel, SimdLevel level) {
    const auto u = this->interpolated(kernel, level);
    const Grid<TypeParam> force = this->spread(kernel, level);
    double power_points = 0, power_nodes = 0;
    for (std::size_t v = 0; v < u.size(); ++v)
      if (this->field.mask[v] == 1) power_points += dot(this->f[v], u[v]);
    for (std::size_t k = 0; k < force.storage.size(); ++k)
      power_nodes += static_cast<double>(force.storage[k]) * this->field.storage[k];
    EXPECT_NEAR(power_points, power_nodes, this->round_off * this->scale);
  });
}

TYPED_TEST(Transfer, SpreadingConservesTheTotalForce) {
  for_all([&](DeltaKernel kernel, SimdLevel level) {
    const Grid<TypeParam> force = this->spread(kernel, level);
    Vec3 spread, given;
    for (std::size_t k = 0; k < force.storage.size(); ++k)
      spread[k / force.layout.count] += force.storage[k];
    for (std::size_t v = 0; v < this->f.size(); ++v)
      if (this->field.mask[v] == 1) given += this->f[v];
    EXPECT_LT(norm(spread - given), this->round_off * this->scale);
  });
}

TEST(TransferErrors, APointOutsideTheHaloOrNotFiniteIsReported) {
  Grid<double> grid;
  std::vector<Vec3> u(grid.x.size());
  for (const Vec3& bad : {Vec3{36, 0, 4}, Vec3{25, 0, NAN}, Vec3{1e300, 0, 0}}) {
    auto x = grid.x;
    x[7] = bad;
    EXPECT_EQ(ibm::interpolate(ibm::DeltaKernel::cosine4, grid.read(), x, {grid.mask, 3, 0}, u,
                               simd_level()),
              7);
  }
}

}  // namespace
