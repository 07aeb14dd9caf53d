// Every membrane law is minus the gradient of its energy, and pushes nothing as a whole.
#include <gtest/gtest.h>

#include <numbers>

#include "membrane/area_volume.hpp"
#include "membrane/bending.hpp"
#include "membrane/springs.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;
using test::Random;

constexpr double gradient_tolerance =
    1e-7;                            // relative to the largest force; differences are good to 1e-9
constexpr double round_off = 1e-13;  // sums of a few terms of the forces' size
constexpr int states = 10000;

TEST(Spring, ForceIsMinusTheEnergyGradient) {
  Random random(1);
  double worst = 0;
  for (int k = 0; k < states; ++k) {
    const auto spring = membrane::make_spring(random.uniform(0.3, 0.6), random.uniform(0.5, 3),
                                              random.uniform(0.001, 0.1), random.uniform(1.5, 4));
    const double l = spring.l_max * random.uniform(0.15, 0.9), h = 6e-6 * l;
    const double slope =
        (membrane::energy(spring, l + h) - membrane::energy(spring, l - h)) / (2 * h);
    const double scale = std::fabs(membrane::tension(spring, l)) + spring.wlc;
    worst = std::max(worst, std::fabs(slope - membrane::tension(spring, l)) / scale);
  }
  EXPECT_LT(worst, gradient_tolerance);
}

TEST(Spring, IsForceFreeAtRestWithTheAskedShearModulus) {
  for (const double x0 : {0.3, 1 / 2.2, 0.5}) {
    const auto s = membrane::make_spring(x0, 1.7, 0.01, 2);
    EXPECT_NEAR(membrane::tension(s, x0 * 1.7), 0, round_off * s.wlc);
    // Eq. 21 written out with p = k_B T/wlc.
    const double l0 = x0 * 1.7;
    const double mu0 = std::sqrt(3.0) * s.wlc / (4 * 1.7 * x0) *
                           (x0 / (2 * std::pow(1 - x0, 3)) - 1 / (4 * (1 - x0) * (1 - x0)) + 0.25) +
                       3 * std::sqrt(3.0) * s.k_p / (4 * l0 * l0 * l0);
    EXPECT_NEAR(mu0, 0.01, 1e-14);
  }
}

TEST(Spring, MatchesTheTabulatedPersistenceLength) {
  // mesh of 642 vertices: l0 = 0.5031 um, x0 = 1/2.2, mu0 = 6.3 uN/m: p = 2.231 nm, k_p = 4.907e-25
  // N m2
  const auto s = membrane::make_spring(1 / 2.2, 0.5031e-6 * 2.2, 6.3e-6, 2);
  EXPECT_NEAR(4.14e-21 / s.wlc, 2.231e-9, 0.002e-9);
  EXPECT_NEAR(s.k_p, 4.907e-25, 0.005e-25);
}

/// Of a triangle: the length over which its area, normal and angles change.
double smallest_height(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({norm(a - b), norm(b - c), norm(c - a)});
  return norm(membrane::twice_area_vector(a, b, c)) / longest;
}

TEST(Area, ForceIsMinusTheEnergyGradient) {
  Random random(2);
  double worst = 0, net = 0;
  for (int k = 0; k < states; ++k) {
    const std::vector<Vec3> x{random.in_cube(1), random.in_cube(1), random.in_cube(1)};
    const double A0 = random.uniform(0.2, 1), stiffness = random.uniform(0.1, 2);
    const Vec3 n2 = membrane::twice_area_vector(x[0], x[1], x[2]);
    const double A = 0.5 * norm(n2);
    if (A < 0.02 || std::fabs(A - A0) < 1e-2) continue;  // slivers, or no force
    const auto F = membrane::area_forces(x[0], x[1], x[2], n2 / (2 * A),
                                         membrane::restoring(stiffness, A, A0));
    const std::vector<Vec3> f{F.a, F.b, F.c};
    net = std::max(net, norm(F.a + F.b + F.c) / (1e-300 + norm(F.a)));
    worst = std::max(
        worst, test::gradient_error(x, f, smallest_height(x[0], x[1], x[2]), [&](const auto& y) {
          return membrane::quadratic(stiffness,
                                     0.5 * norm(membrane::twice_area_vector(y[0], y[1], y[2])), A0);
        }));
  }
  EXPECT_LT(worst, gradient_tolerance);
  EXPECT_LT(net, 1e-11) << "slivers lose digits in their normals";
}

/// A closed octahedron with random corners, outwards.
struct Octahedron {
  std::vector<Vec3> x;
  static constexpr int triangle[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                         {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  explicit Octahedron(Random& random)
      : x{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}} {
    const Vec3 away = random.in_cube(20);
    for (auto& p : x) p += random.in_cube(0.3) + away;
  }
  static double volume(const std::vector<Vec3>& x) {
    double v = 0;
    for (const auto& t : triangle)
      v += membrane::volume_under(x[static_cast<std::size_t>(t[0])],
                                  x[static_cast<std::size_t>(t[1])],
                                  x[static_cast<std::size_t>(t[2])]);
    return v;
  }
};

TEST(Volume, ForceIsMinusTheEnergyGradientAndFreeOfNetForceAndTorque) {
  Random random(3);
  double worst = 0, net = 0;
  for (int k = 0; k < states; ++k) {
    const Octahedron o(random);
    const double V = Octahedron::volume(o.x), V0 = random.uniform(0.5, 2);
    ASSERT_GT(V, 0);
    std::vector<Vec3> f(6);
    for (const auto& t : Octahedron::triangle) {
      const auto F =
          membrane::volume_forces(membrane::twice_area_vector(o.x[static_cast<std::size_t>(t[0])],
                                                              o.x[static_cast<std::size_t>(t[1])],
                                                              o.x[static_cast<std::size_t>(t[2])]),
                                  membrane::restoring(1, V, V0));
      f[static_cast<std::size_t>(t[0])] += F.a;
      f[static_cast<std::size_t>(t[1])] += F.b;
      f[static_cast<std::size_t>(t[2])] += F.c;
    }
    Vec3 force, torque;
    double scale = 1e-300;
    for (std::size_t i = 0; i < 6; ++i) {
      force += f[i];
      torque += cross(o.x[i] - o.x[0], f[i]);
      scale = std::max(scale, norm(f[i]));
    }
    net = std::max({net, norm(force) / scale, norm(torque) / scale});
    if (std::fabs(V - V0) < 1e-2) continue;  // the force itself vanishes
    std::vector<Vec3> centred = o.x;
    for (auto& p : centred) p -= o.x[0];
    worst = std::max(worst, test::gradient_error(centred, f, 1, [&](const auto& y) {
                       return membrane::quadratic(1, Octahedron::volume(y), V0);
                     }));
  }
  EXPECT_LT(worst, gradient_tolerance);
  EXPECT_LT(net, 1e-12);
}

TEST(Bending, ForceIsMinusTheEnergyGradientFlatAndConcaveHingesIncluded) {
  Random random(4);
  double worst = 0, net = 0, turn = 0;
  for (int k = 0; k < states; ++k) {
    // Hinge with its edge along y, opened by `theta`: flat and both senses, with a little noise on
    // every corner.
    const double theta = k % 10 == 0 ? 0.0 : random.uniform(-2.5, 2.5);
    std::vector<Vec3> x{{-std::cos(theta / 2), random.uniform(0.2, 0.8), -std::sin(theta / 2)},
                        {0, 0, 0},
                        {0, 1, 0},
                        {std::cos(theta / 2), random.uniform(0.2, 0.8), -std::sin(theta / 2)}};
    if (k % 10 != 0)
      for (auto& p : x) p += random.in_cube(0.2);
    const double theta0 = random.uniform(-1, 1);
    const membrane::Bending law{random.uniform(0.1, 1), std::sin(theta0), std::cos(theta0)};
    const auto hinge = membrane::make_hinge(x[0], x[1], x[2], x[3]);
    const auto F = membrane::forces(law, hinge, x[0], x[1], x[3]);
    const std::vector<Vec3> f{F.f1, F.f2, F.f3, F.f4};
    Vec3 force, torque;
    for (std::size_t i = 0; i < 4; ++i) force += f[i], torque += cross(x[i], f[i]);
    net = std::max(net, norm(force));
    turn = std::max(turn, norm(torque));
    if (std::fabs(hinge.theta.angle() - theta0) < 1e-2) continue;  // the force itself vanishes
    worst = std::max(
        worst,
        test::gradient_error(
            x, f, std::min(smallest_height(x[0], x[1], x[2]), smallest_height(x[3], x[2], x[1])),
            [&](const auto& y) {
              return membrane::energy(law, membrane::make_hinge(y[0], y[1], y[2], y[3]).theta);
            }));
  }
  EXPECT_LT(worst, gradient_tolerance);
  EXPECT_LT(net, round_off * 10);
  EXPECT_LT(turn, round_off * 10);
}

TEST(Bending, ConvexHingesArePositive) {
  const double theta = 0.7;
  const Vec3 p1{-std::cos(theta / 2), 0.5, -std::sin(theta / 2)},
      p4{std::cos(theta / 2), 0.5, -std::sin(theta / 2)};
  EXPECT_NEAR(membrane::make_hinge(p1, {0, 0, 0}, {0, 1, 0}, p4).theta.angle(), theta, 1e-14);
}

}  // namespace
