// The barrier between a carrier and a triangle.
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "contact/surface_barrier.hpp"
#include "support/gradient.hpp"
#include "support/shapes.hpp"

namespace {

using namespace hemomag;
using contact::SurfaceBarrier;
using lattice::Triangle;

constexpr double gradient_tolerance = 1e-7;
const SurfaceBarrier barrier{0.3, 0.8};

TEST(SurfaceBarrier, HasTheForceAndTheStiffnessItIsNamedFor) {
  EXPECT_EQ(force(barrier, barrier.range), 0);
  EXPECT_EQ(energy(barrier, barrier.range), 0);
  EXPECT_EQ(force(barrier, 2), 0);
  // k R (R - d)/d: at half the range k R, at a quarter 3 k R.
  EXPECT_DOUBLE_EQ(force(barrier, 0.4), 0.3 * 0.8);
  EXPECT_DOUBLE_EQ(force(barrier, 0.2), 3 * 0.3 * 0.8);
  EXPECT_NEAR(force(barrier, 0.8 - 1e-6) / 1e-6, 0.3, 1e-5);
  EXPECT_GT(force(barrier, 1e-6), 1e5) << "no force brings a point to the surface";
}

/// Which of the corners the nearest point is made of: face, edge or corner.
int region(const std::vector<Vec3>& x) {
  int bits = 0;
  const auto foot = lattice::nearest_point(x[3], {x[0], x[1], x[2]});
  for (std::size_t k = 0; k < 3; ++k) bits |= (foot.weight[k] > 0) << k;
  return bits;
}

TEST(SurfaceBarrier, ForcesAreMinusTheGradientAndLeaveMomentumAlone) {
  test::Random random(7);
  int checked[4] = {};  // by the number of corners
  for (int n = 0; n < 600; ++n) {
    std::vector<Vec3> x;
    for (int k = 0; k < 4; ++k) x.push_back(random.in_cube(1));
    x[3] = (1. / 3) * (x[0] + x[1] + x[2]) + 0.6 * x[3];
    const auto at = contact::barrier_forces(barrier, x[3], {x[0], x[1], x[2]});
    if (at.energy == 0) continue;
    const std::array<Vec3, 4> f{at.corner[0], at.corner[1], at.corner[2], at.point};
    const double scale = norm(at.point);
    Vec3 sum, torque;
    for (std::size_t k = 0; k < 4; ++k) {
      sum += f[k];
      torque += cross(x[k], f[k]);
    }
    EXPECT_LT(norm(sum), 1e-13 * scale);
    EXPECT_LT(norm(torque), 1e-12 * scale);
    // Where the nearest point passes from a face to an edge the second derivative jumps: no
    // difference is taken across.
    const double distance = norm(x[3] - lattice::nearest_point(x[3], {x[0], x[1], x[2]}).x);
    bool smooth = distance < 0.99 * barrier.range;
    const int here = region(x);
    const double error = test::gradient_error(x, f, distance, [&](const std::vector<Vec3>& y) {
      smooth = smooth && region(y) == here;
      return contact::barrier_forces(barrier, y[3], {y[0], y[1], y[2]}).energy;
    });
    if (!smooth) continue;
    ++checked[(here & 1) + (here >> 1 & 1) + (here >> 2 & 1)];
    EXPECT_LT(error, gradient_tolerance) << n;
  }
  for (int corners = 1; corners <= 3; ++corners) EXPECT_GT(checked[corners], 10) << corners;
}

TEST(SurfaceBarrier, HoldsAPointOffEveryPlaceOfASurface) {
  // Pressed towards a sphere's mesh from outside along any direction, the force away at a
  // hundredth of the range is more than at half the range, and outwards.
  const auto sphere = test::icosphere(3, 2);
  std::mt19937_64 random(3);
  std::normal_distribution<double> gauss;
  const auto push = [&](const Vec3& p) {
    Vec3 f;
    for (const auto& t : sphere.triangles)
      f += contact::barrier_forces(barrier, p,
                                   {sphere.points[std::size_t(t[0])],
                                    sphere.points[std::size_t(t[1])],
                                    sphere.points[std::size_t(t[2])]})
               .point;
    return f;
  };
  for (int n = 0; n < 300; ++n) {
    Vec3 out{gauss(random), gauss(random), gauss(random)};
    out *= 1 / norm(out);
    // Where the ray meets the mesh: nearest triangle by bisection of the unsigned distance's least.
    double surface = 0;
    for (const auto& t : sphere.triangles) {
      const Vec3 &a = sphere.points[std::size_t(t[0])], &b = sphere.points[std::size_t(t[1])],
                 &c = sphere.points[std::size_t(t[2])];
      const Vec3 normal = cross(b - a, c - a);
      const double r = dot(a, normal) / dot(out, normal);
      const Vec3 p = r * out;
      if (r > 0 && norm(p - lattice::nearest_point(p, {a, b, c}).x) < 1e-9) surface = r;
    }
    ASSERT_GT(surface, 0);
    const double near = dot(push((surface + 0.01 * barrier.range) * out), out);
    const double half = dot(push((surface + 0.5 * barrier.range) * out), out);
    EXPECT_GT(half, 0.5 * barrier.stiffness * barrier.range);
    EXPECT_GT(near, 10 * half);
  }
}

}  // namespace
