// The distance to a closed surface against closed forms and against all triangles, one by one.
#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "lattice/surface_vessel.hpp"
#include "support/shapes.hpp"

namespace {

using namespace hemomag;
using lattice::Surface;
using lattice::SurfaceVessel;

// Lengths of order 10 through a few dozen operations.
constexpr double round_off = 1e-12;
// Points this near to the surface may be on either side of it after round-off.
constexpr double unsure = 1e-10;

/// Distance to a triangle: minimum over its inside, if the foot lies there, and its three sides.
double distance_to_triangle(const Vec3& x, const std::array<Vec3, 3>& p) {
  double best2 = std::numeric_limits<double>::infinity();
  const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
  const Vec3 foot = x - (dot(x - p[0], n) / norm2(n)) * n;
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = p[k], e = p[(k + 1) % 3] - a;
    inside = inside && dot(cross(e, foot - a), n) >= 0;
    best2 = std::min(best2, norm2(a + std::clamp(dot(x - a, e) / norm2(e), 0.0, 1.0) * e - x));
  }
  return std::sqrt(inside ? std::min(best2, norm2(foot - x)) : best2);
}

/// Solid angle of a triangle seen from x (van Oosterom and Strackee 1983, eq. 8).
double solid_angle(const Vec3& x, const std::array<Vec3, 3>& p) {
  const Vec3 a = p[0] - x, b = p[1] - x, c = p[2] - x;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  return 2 * std::atan2(dot(a, cross(b, c)),
                        la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// Positive inside, where the surface fills the whole sphere of directions.
double reference_distance(const Surface& s, const Vec3& x) {
  double nearest = std::numeric_limits<double>::infinity(), seen = 0;
  for (const auto& [a, b, c] : s.triangles) {
    const std::array p{s.points[std::size_t(a)], s.points[std::size_t(b)],
                       s.points[std::size_t(c)]};
    nearest = std::min(nearest, distance_to_triangle(x, p));
    seen += solid_angle(x, p);
  }
  return seen > 2 * std::numbers::pi ? nearest : -nearest;
}

Vec3 random_in_box(std::mt19937_64& random, double low, double high) {
  std::uniform_real_distribution<double> u(low, high);
  return {u(random), u(random), u(random)};
}

/// Random points of the space around a surface, and points close to its corners, edges and faces.
std::vector<Vec3> queries(const Surface& s, double half_width) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> fraction(0, 1);
  std::vector<Vec3> found;
  for (int i = 0; i < 2000; ++i) found.push_back(random_in_box(random, -half_width, half_width));
  for (int i = 0; i < 3000; ++i) {
    const auto& t = s.triangles[random() % s.triangles.size()];
    const auto p = [&](std::size_t k) { return s.points[std::size_t(t[k])]; };
    const double u = fraction(random), v = fraction(random) * (1 - u);
    const Vec3 on_face = p(0) + u * (p(1) - p(0)) + v * (p(2) - p(0));
    const Vec3 on_edge = p(0) + u * (p(1) - p(0));
    const double reach = std::pow(10.0, -4 * fraction(random));  // 1e-4 to 1
    const Vec3 away = reach * random_in_box(random, -1, 1);
    found.push_back((i % 3 == 0 ? p(0) : i % 3 == 1 ? on_edge : on_face) + away);
  }
  return found;
}

void expect_reference_distances(const Surface& s, double half_width) {
  const SurfaceVessel vessel(s);
  int wrong_side = 0;
  double error = 0;
  for (const Vec3& x : queries(s, half_width)) {
    const double expected = reference_distance(s, x), measured = vessel.distance(x);
    error = std::max(error, std::abs(std::abs(measured) - std::abs(expected)));
    if (std::abs(expected) > unsure && expected * measured < 0) ++wrong_side;
  }
  EXPECT_EQ(wrong_side, 0);
  EXPECT_LT(error, round_off);
}

TEST(SurfaceVessel, DistanceToACubeIsExact) {
  constexpr double side = 7.5;
  const SurfaceVessel vessel(test::cube(side));
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x = random_in_box(random, -5, 12.5);
    Vec3 beyond;
    double inside = side;
    for (std::size_t d = 0; d < 3; ++d) {
      beyond[d] = std::max({-x[d], x[d] - side, 0.0});
      inside = std::min({inside, x[d], side - x[d]});
    }
    const double expected = inside > 0 ? inside : -norm(beyond);
    ASSERT_NEAR(vessel.distance(x), expected, round_off);
  }
}

TEST(SurfaceVessel, DistanceBeyondCornersAndEdgesOfACubeIsExact) {
  const SurfaceVessel vessel(test::cube(2));
  for (const double t : {1e-9, 1e-3, 1.0, 100.0}) {
    const double scale = 1 + t;  // of the numbers that are rounded
    EXPECT_NEAR(vessel.distance({2 + t, 2 + t, 2 + t}), -std::sqrt(3) * t, scale * round_off);
    EXPECT_NEAR(vessel.distance({-t, -t, -t}), -std::sqrt(3) * t, scale * round_off);
    EXPECT_NEAR(vessel.distance({1, 2 + t, -t}), -std::sqrt(2) * t, scale * round_off);
    EXPECT_NEAR(vessel.distance({1, 1, -t}), -t, scale * round_off);  // a diagonal of a side
  }
  EXPECT_EQ(vessel.distance({0, 0, 0}), 0);
  EXPECT_NEAR(vessel.distance({1, 1, 1}), 1, round_off);
}

TEST(SurfaceVessel, DistanceToASphereIsThatToItsNearestTriangle) {
  expect_reference_distances(test::icosphere(5, 3), 8);
}
TEST(SurfaceVessel, DistanceToATorusIsThatToItsNearestTriangle) {
  expect_reference_distances(test::torus(6, 2.5, 40, 20), 10);
}
TEST(SurfaceVessel, DistanceToSpikesAndPitsIsThatToTheNearestTriangle) {
  expect_reference_distances(test::spiky(5, 2), 9);
}

TEST(SurfaceVessel, DistanceConvergesToThatOfTheSphereInSecondOrder) {
  // Faces lie within the sphere by at most (edge)^2 / (6 radius), and edges halve with each level.
  const auto worst = [](int levels) {
    const SurfaceVessel vessel(test::icosphere(5, levels));
    std::mt19937_64 random(7);
    double error = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3 x = random_in_box(random, -8, 8);
      error = std::max(error, std::abs(vessel.distance(x) - (5 - norm(x))));
    }
    return error;
  };
  EXPECT_NEAR(std::log2(worst(3) / worst(4)), 2, 0.1);
}

TEST(SurfaceVessel, AHollowIsOutside) {
  Surface shell = test::icosphere(5, 3);
  Surface hollow = test::icosphere(2, 2);
  const int n = int(shell.points.size());
  shell.points.insert(shell.points.end(), hollow.points.begin(), hollow.points.end());
  for (const auto& [a, b, c] : hollow.triangles) shell.triangles.push_back({a + n, c + n, b + n});
  const SurfaceVessel vessel(shell);
  EXPECT_LT(vessel.distance({0.1, 0, 0}), 0);
  EXPECT_GT(vessel.distance({3.5, 0, 0}), 0);
  EXPECT_LT(vessel.distance({6, 0, 0}), 0);
}

TEST(SurfaceVessel, AnInwardSurfaceIsTurned) {
  Surface inward = test::torus(6, 2.5, 40, 20);
  const SurfaceVessel outward(inward);
  for (auto& t : inward.triangles) std::swap(t[0], t[1]);
  const SurfaceVessel turned(inward);
  EXPECT_NEAR(turned.distance({6, 0.2, 0.3}), outward.distance({6, 0.2, 0.3}), round_off);
  EXPECT_GT(turned.distance({6, 0.2, 0.3}), 2);
}

TEST(SurfaceVessel, AnOpenSurfaceIsNone) {
  Surface open = test::cube(1);
  open.triangles.pop_back();
  EXPECT_THROW(SurfaceVessel{open}, Error);
  EXPECT_THROW(SurfaceVessel{Surface{}}, Error);
}

}  // namespace
