// Magnetic and contact laws: gradients, third law, tabulated values.
#include <gtest/gtest.h>

#include <numbers>

#include "contact/lennard_jones.hpp"
#include "contact/morse.hpp"
#include "contact/wall.hpp"
#include "lattice/vessel.hpp"
#include "magnetic/dipole.hpp"
#include "magnetic/field.hpp"
#include "magnetic/moment.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;
using test::Random;

constexpr double gradient_tolerance = 1e-7;
constexpr double mu = 4e-7 * std::numbers::pi;

TEST(Dipoles, ForceIsMinusTheEnergyGradientAtFixedMoments) {
  Random random(5);
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 mi = random.in_cube(1), mj = random.in_cube(1);
    const std::vector<Vec3> r{random.in_cube(1) + Vec3{1.5, 0, 0}};
    const auto pair = magnetic::dipole_dipole(mi, mj, r[0]);
    worst = std::max(worst,
                     test::gradient_error(r, std::vector<Vec3>{pair.on_j}, 0.5, [&](const auto& y) {
                       return magnetic::dipole_dipole(mi, mj, y[0]).energy;
                     }));
    const Vec3 back = magnetic::dipole_dipole(mj, mi, -r[0]).on_j;
    EXPECT_LT(norm(back + pair.on_j), 1e-14 * (1 + norm(back))) << "third law";
  }
  EXPECT_LT(worst, gradient_tolerance);
}

TEST(Dipoles, RadialPartChangesSignAtTheMagicAngle) {
  const double magic = std::acos(std::sqrt(1.0 / 3));
  const auto radial = [](double phi) {
    const Vec3 m{std::cos(phi), std::sin(phi), 0};
    return magnetic::dipole_dipole(m, m, {2, 0, 0}).on_j.x;
  };
  EXPECT_LT(radial(magic - 0.01), 0);
  EXPECT_GT(radial(magic + 0.01), 0);
  EXPECT_NEAR(radial(magic), 0, 1e-16);
}

TEST(Dipoles, ContactPullIsAnEighthOfF0) {
  const double a = 0.7, m = 0.3, F0 = 3 * m * m / (4 * std::numbers::pi * std::pow(a, 4));
  EXPECT_NEAR(magnetic::contact_pull(m, m, 2 * a), F0 / 8, 1e-15);
  EXPECT_NEAR(-magnetic::dipole_dipole({m, 0, 0}, {m, 0, 0}, {2 * a, 0, 0}).on_j.x, F0 / 8, 1e-15);
}

TEST(Dipoles, ReproduceTheTabulatedForces) {
  // a = 125 nm, f = 0.6, chi = 0.4, B0 = 0.1 T, H = 24 um: 0.651 pN at the wall, 3.75 pN at
  // contact. In SI with lengths in metres and B / sqrt(mu*) the formulas with mu* = 1 give newtons.
  const double a = 125e-9, chi_volume = 0.4 * 0.6 * 4 / 3 * std::numbers::pi * a * a * a, H = 24e-6;
  const double b = 0.1 / std::sqrt(mu);
  const magnetic::AxialGradient field{2, b / H, H};
  const auto wall = field({0, 0, 0});
  const Vec3 m = magnetic::linear_moment(chi_volume, wall.B);
  EXPECT_NEAR(magnetic::gradient_force(m, wall).z, -0.651e-12, 0.001e-12);
  EXPECT_NEAR(magnetic::contact_pull(norm(m), norm(m), 2 * a), 3.75e-12, 0.01e-12);
}

TEST(Repulsion, ForcesAreMinusTheEnergyGradient) {
  Random random(6);
  double soft = 0, paper = 0;
  for (int k = 0; k < 2000; ++k) {
    Vec3 e = random.in_cube(1);
    e *= 1 / norm(e);
    const std::vector<Vec3> near{random.uniform(0.9, 1.2) * e},
        tight{random.uniform(1.03, 1.045) * e};
    const auto s = magnetic::soft_repulsion(2.0, 30, 1.0, near[0]);
    soft = std::max(soft,
                    test::gradient_error(near, std::vector<Vec3>{s.on_j}, 0.05, [](const auto& y) {
                      return magnetic::soft_repulsion(2.0, 30, 1.0, y[0]).energy;
                    }));
    const auto p = magnetic::paper_repulsion(0.1, 0.05, 1.0, tight[0]);
    paper = std::max(
        paper, test::gradient_error(tight, std::vector<Vec3>{p.on_j}, 0.01, [](const auto& y) {
          return magnetic::paper_repulsion(0.1, 0.05, 1.0, y[0]).energy;
        }));
  }
  EXPECT_LT(soft, gradient_tolerance);
  EXPECT_LT(paper, gradient_tolerance);
}

TEST(Contact, ForcesAreMinusTheEnergyGradient) {
  const contact::Morse morse{0.3, 1.92, 1.0, 3.0};
  const contact::LennardJones lj{0.02, 1.0};
  for (double r = 0.8; r < 3; r += 0.01) {
    const double h = 6e-6;
    const double slope = (contact::energy(morse, r + h) - contact::energy(morse, r - h)) / (2 * h);
    EXPECT_NEAR(contact::force(morse, r), -slope, gradient_tolerance);
    if (r > contact::lj_cutoff_over_sigma - h) continue;
    const double lj_slope =
        (contact::energy(lj, (r + h) * (r + h)) - contact::energy(lj, (r - h) * (r - h))) / (2 * h);
    EXPECT_NEAR(contact::force_over_r(lj, r * r) * r, -lj_slope,
                gradient_tolerance * (1 + std::fabs(lj_slope)));
  }
  const double cut = contact::lj_cutoff_over_sigma * lj.sigma;
  EXPECT_NEAR(contact::energy(lj, cut * cut), 0, 1e-15) << "shifted to zero at the cut";
  EXPECT_NEAR(contact::force_over_r(lj, cut * cut), 0, 1e-13);
  EXPECT_NEAR(contact::energy(morse, morse.r0), -morse.depth, 1e-15);
}

TEST(WallRepulsion, ForceIsMinusTheEnergySlope) {
  const contact::WallRepulsion purely{0.02, 0.5, 0.5 * contact::lj_cutoff_over_sigma};
  const contact::WallRepulsion with_well{0.3, 0.7, 1.9};
  for (const auto& wall : {purely, with_well})
    for (double d = 0.4 * wall.sigma; d < 0.99 * wall.cutoff; d += 0.01 * wall.cutoff) {
      const double slope =
          test::slope_at_zero(0.5 * d, [&](double h) { return contact::energy(wall, d + h); });
      EXPECT_NEAR(contact::force(wall, d), -slope, gradient_tolerance * (1 + std::fabs(slope)));
    }
}

TEST(WallRepulsion, IsThatOfAPairAtTheSameDistanceAndVanishesAtItsCut) {
  const contact::LennardJones pair{0.02, 0.5};
  const contact::WallRepulsion wall{0.02, 0.5, 0.5 * contact::lj_cutoff_over_sigma};
  for (double d = 0.2; d < wall.cutoff; d += 0.01) {
    const double scale = 1 + contact::energy(pair, d * d) + contact::force_over_r(pair, d * d);
    EXPECT_NEAR(contact::energy(wall, d), contact::energy(pair, d * d), 1e-13 * scale);
    EXPECT_NEAR(contact::force(wall, d), d * contact::force_over_r(pair, d * d), 1e-13 * scale);
  }
  const contact::WallRepulsion with_well{0.3, 0.7, 1.9};
  EXPECT_NEAR(contact::energy(with_well, 1.9 * (1 - 1e-15)), 0, 1e-14) << "shifted to zero";
  EXPECT_EQ(contact::energy(with_well, 1.9), 0);
  EXPECT_EQ(contact::force(with_well, 2.5), 0);
  // sigma/d = 1: 4 eps (1 - 1) less the value at the cut, and 24 eps/sigma.
  const double c6 = std::pow(0.7 / 1.9, 6);
  EXPECT_NEAR(contact::energy(with_well, 0.7), 4 * 0.3 * (c6 - c6 * c6), 1e-15);
  EXPECT_NEAR(contact::force(with_well, 0.7), 24 * 0.3 / 0.7, 1e-14);
}

TEST(WallRepulsion, InATubePushesTowardsItsAxisByTheEnergyGradient) {
  const lattice::Tube tube(1, {5, 0, 6}, 4);
  const contact::WallRepulsion wall{0.02, 1, contact::lj_cutoff_over_sigma};
  Random random(11);
  for (int k = 0; k < 500; ++k) {
    const double r = random.uniform(3.0, 3.5), phi = random.uniform(0, 2 * std::numbers::pi);
    const Vec3 out{std::cos(phi), 0, std::sin(phi)};
    const std::vector<Vec3> x{Vec3{5, random.uniform(-9, 9), 6} + r * out};
    const Vec3 F = -contact::force(wall, tube.distance(x[0])) * out;
    EXPECT_LT(test::gradient_error(
                  x, std::vector<Vec3>{F}, 0.25,
                  [&](const auto& y) { return contact::energy(wall, tube.distance(y[0])); }),
              gradient_tolerance);
  }
}

}  // namespace
