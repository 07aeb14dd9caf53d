// The shape of a cell against ellipsoids in closed form.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "analysis/cell_shape.hpp"
#include "support/gradient.hpp"
#include "support/shapes.hpp"

namespace {

using namespace hemomag;
using std::numbers::pi;

constexpr double round_off = 1e-12;  // 1,280 tetrahedra, corners of order 1 to 10
constexpr double degree = pi / 180;

/// Rotation by `angle` about a unit axis (Rodrigues).
Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
         (1 - std::cos(angle)) * dot(axis, v) * axis;
}

template <class Map> test::Surface mapped(test::Surface s, Map map) {
  for (Vec3& x : s.points) x = map(x);
  return s;
}

analysis::CellShape shape_of(const test::Surface& s) {
  analysis::SolidMoments m;
  for (const auto& [i, j, k] : s.triangles)
    m.add(s.points[std::size_t(i)], s.points[std::size_t(j)], s.points[std::size_t(k)]);
  return analysis::cell_shape(m);
}

/// Area of a triaxial ellipsoid by quadrature of |x_u cross x_v| over the angles (midpoint rule in
/// cos(theta) and phi, converged to 1e-7 here).
double ellipsoid_area(double a, double b, double c) {
  constexpr int n = 1000;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double w = -1 + 2 * (i + 0.5) / n, phi = 2 * pi * (j + 0.5) / n;
      const double s = std::sqrt(1 - w * w);
      const Vec3 normal{b * c * s * std::cos(phi), a * c * s * std::sin(phi), a * b * w};
      sum += norm(normal);
    }
  return sum * 4 * pi / (n * n);
}

TEST(CellShape, OfABoxIsExactFromAnyPoint) {
  // lambda of a box is side^2/12; the moments of a flat-faced solid have no mesh error.
  const Vec3 side{2, 5, 3}, shift{-4, 7, 1.5};
  const auto box = mapped(test::cube(1), [&](const Vec3& x) {
    return Vec3{side.x * x.x, side.y * x.y, side.z * x.z} + shift;
  });
  const auto s = shape_of(box);
  EXPECT_NEAR(s.volume, 30, 30 * round_off);
  EXPECT_NEAR(s.area, 62, 62 * round_off);
  EXPECT_LT(norm(s.centre - (0.5 * side + shift)), 10 * round_off);
  const std::array<double, 3> sides{5, 3, 2};
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(s.semi_axes[k], sides[k] * std::sqrt(5.0 / 12), 10 * round_off);
  EXPECT_NEAR(s.taylor, 3.0 / 7, 10 * round_off);
  EXPECT_NEAR(s.taylor_in_plane, 2.0 / 8, 10 * round_off);
  EXPECT_NEAR(s.inclination, 0, 10 * round_off);
}

TEST(CellShape, OfAnEllipsoidConvergesWithSecondOrder) {
  const double a = 4, b = 2.5, c = 1.2;
  const Vec3 axis = Vec3{1, -2, 0.7} / norm(Vec3{1, -2, 0.7}), at{3, -8, 5};
  const double area = ellipsoid_area(a, b, c);
  std::array<std::array<double, 5>, 3> errors{};
  for (int level = 2; level <= 4; ++level) {
    const auto s = shape_of(mapped(test::icosphere(1, level), [&](const Vec3& x) {
      return turned({a * x.x, b * x.y, c * x.z}, axis, 0.8) + at;
    }));
    errors[std::size_t(level - 2)] = {
        std::fabs(s.volume / (4 * pi / 3 * a * b * c) - 1), std::fabs(s.area / area - 1),
        std::fabs(s.semi_axes[0] / a - 1), std::fabs(s.semi_axes[1] / b - 1),
        std::fabs(s.semi_axes[2] / c - 1)};
    EXPECT_LT(norm(s.centre - at), 10 * round_off);
    // An icosphere has the symmetry of the icosahedron, so a rotated and stretched one has the
    // moments of a true ellipsoid but for a factor: the directions are exact.
    const std::array<Vec3, 3> along{turned({1, 0, 0}, axis, 0.8), turned({0, 1, 0}, axis, 0.8),
                                    turned({0, 0, 1}, axis, 0.8)};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT(norm(cross(s.directions[k], along[k])), 100 * round_off) << "axis " << k;
      EXPECT_GT(dot(s.directions[k], Vec3{1, std::numbers::sqrt2, std::numbers::sqrt3}), 0);
    }
    EXPECT_NEAR(s.taylor, (a - c) / (a + c), 10 * round_off);
  }
  for (std::size_t k = 0; k < 5; ++k) {
    const double order = std::log2(errors[1][k] / errors[2][k]);
    std::printf("ellipsoid, 2562 vertices: error %.2e of quantity %zu, order %.3f\n", errors[2][k],
                k, order);
    EXPECT_LT(errors[2][k], 3e-3)
        << "volume of chords on a sphere: 3 h^2/8 = 2.1e-3, mean edge h = 0.075";
    EXPECT_NEAR(order, 2, 0.1);
  }
}

TEST(CellShape, InclinationAndTaylorDeformationInTheShearPlane) {
  const double a = 4, b = 2.5, c = 1.2;
  for (const double theta : {-89.0, -45.0, -10.0, 0.0, 25.0, 45.0, 60.0, 90.0}) {
    // The long axis starts along y, the short one along z and the middle one along x.
    const auto s = shape_of(mapped(test::icosphere(1, 2), [&](const Vec3& x) {
      return turned({b * x.x, a * x.y, c * x.z}, {1, 0, 0}, theta * degree);
    }));
    EXPECT_NEAR(std::remainder(s.inclination / degree - theta, 180), 0, 1e-9);
    EXPECT_GT(s.inclination, -pi / 2);
    EXPECT_LE(s.inclination, pi / 2);
    EXPECT_NEAR(s.taylor_in_plane, (a - c) / (a + c), 10 * round_off);
    EXPECT_NEAR(s.taylor, (a - c) / (a + c), 10 * round_off);
  }
  // Seen along its middle and long axis in the plane: the plane knows another deformation.
  const auto rolling = shape_of(mapped(test::icosphere(1, 2), [&](const Vec3& x) {
    return Vec3{c * x.x, b * x.y, a * x.z};
  }));
  EXPECT_NEAR(rolling.taylor_in_plane, (a - b) / (a + b), 10 * round_off);
  EXPECT_NEAR(rolling.taylor, (a - c) / (a + c), 10 * round_off);
  EXPECT_NEAR(rolling.inclination, pi / 2, 10 * round_off);
}

TEST(CellShape, MomentsOfPartsAdd) {
  const auto s = test::icosphere(2, 2);
  analysis::SolidMoments whole, part[2];
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const auto& [i, j, k] = s.triangles[t];
    const Vec3 &a = s.points[std::size_t(i)], &b = s.points[std::size_t(j)],
               &c = s.points[std::size_t(k)];
    whole.add(a, b, c);
    part[t % 2].add(a, b, c);
  }
  EXPECT_NEAR(part[0].volume + part[1].volume, whole.volume, 100 * round_off);
  EXPECT_NEAR(part[0].area + part[1].area, whole.area, 100 * round_off);
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(part[0].second[k] + part[1].second[k], whole.second[k], 100 * round_off);
}

TEST(NearestTurn, FollowsARotationOverSeveralTurnsBothWays) {
  for (const double step : {0.4 * pi, -0.9 * pi, 0.01}) {
    double followed = 0.3;
    for (int k = 1; k <= 50; ++k) {
      const double angle = 0.3 + k * step;
      followed = analysis::nearest_turn(std::remainder(angle, 2 * pi), followed, 2 * pi);
      EXPECT_NEAR(followed, angle, 1e-12 * (1 + std::fabs(angle)));
    }
  }
}

}  // namespace
