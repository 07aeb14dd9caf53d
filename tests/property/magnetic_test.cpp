// Magnetic and contact laws: gradients, third law, tabulated values.
#include <gtest/gtest.h>

#include <numbers>

#include "base/simd.hpp"
#include "contact/lennard_jones.hpp"
#include "contact/morse.hpp"
#include "contact/wall.hpp"
#include "lattice/vessel.hpp"
#include "magnetic/dipole.hpp"
#include "magnetic/dipole_rows.hpp"
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
    EXPECT_EQ(magnetic::dipole_dipole(mj, mi, -r[0]).on_j, -pair.on_j)
        << "the third law holds to the last bit";
  }
  constexpr double dipole_tolerance = 1e-9;  // relative; five-point differences reach 1e-11
  EXPECT_LT(worst, dipole_tolerance);
}

class DipoleRows : public testing::TestWithParam<SimdLevel> {};

TEST_P(DipoleRows, EqualTheLawOfOnePair) {
  // Reference against fast: one carrier and up to a full row of neighbours within and beyond reach.
  if (GetParam() > simd_level()) GTEST_SKIP() << "not on this processor";
  Random random(21);
  constexpr double cutoff = 3, contact = 1.1, round_off = 64 * 2.3e-16;
  constexpr int mask = 0x1fffffff, flag = 0x20000000;  // neighbours may carry marks in high bits
  for (const int count : {0, 1, 7, 100, static_cast<int>(magnetic::most_in_row)}) {
    const auto n = static_cast<std::size_t>(count) + 1;
    std::vector<Vec3> x, m, f(n), expected(n);
    std::vector<int> neighbours, touching(magnetic::most_in_row), near;
    for (std::size_t k = 0; k < n; ++k) {
      Vec3 e = random.in_cube(1);
      e *= 1 / norm(e);
      x.push_back(k == 0 ? Vec3{0.3, 0.2, 0.1} : x[0] + random.uniform(0.9, 4) * e);
      m.push_back(random.in_cube(1));
      if (k == 0) continue;
      const int j = static_cast<int>(k);
      neighbours.push_back(k % 3 == 0 ? j | flag : j);
      const Vec3 r = x[k] - x[0];
      if (norm(r) < contact) near.push_back(j);
      if (norm(r) >= cutoff) continue;
      const Vec3 F = magnetic::dipole_dipole(m[0], m[k], r).on_j;
      expected[k] += F;
      expected[0] -= F;
    }
    const magnetic::DipoleRow row{&x[0].x,           &m[0].x, &f[0].x,         0,
                                  neighbours.data(), mask,    count,           cutoff * cutoff,
                                  contact * contact, touching.data()};
    const auto touch = GetParam() == SimdLevel::avx512 ? magnetic::avx512::dipole_row(row)
                       : GetParam() == SimdLevel::avx2 ? magnetic::avx2::dipole_row(row)
                                                       : magnetic::sse2::dipole_row(row);
    touching.resize(static_cast<std::size_t>(touch));
    EXPECT_EQ(touching, near);
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_LT(norm(f[k] - expected[k]), round_off * (1 + static_cast<double>(k == 0 ? n : 1)))
          << "neighbour " << k << " of " << count;
  }
}

INSTANTIATE_TEST_SUITE_P(All, DipoleRows,
                         testing::Values(SimdLevel::sse2, SimdLevel::avx2, SimdLevel::avx512),
                         [](const auto& level) { return std::string(name(level.param)); });

TEST(Dipoles, AJointOfALongChainCarriesZetaOfThree) {
  // Force between the halves of a straight chain, in pulls of a touching pair.
  constexpr int half = 200;
  double sum = 0;
  for (int i = 1; i <= half; ++i)
    for (int j = 1; j <= half; ++j)
      sum -= magnetic::dipole_dipole({0, 0, 1}, {0, 0, 1}, {0, 0, i + j - 1.0}).on_j.z;
  constexpr double rest = 1e-4;  // pairs farther apart: 3/(2 half^2)
  EXPECT_NEAR(sum / magnetic::contact_pull(1, 1, 1), magnetic::chain_load, rest);
}

TEST(Dipoles, StiffnessIsTheSlopeOfTheShortestWaveOfAChain) {
  // Every other carrier of a long chain at rest is moved; the middle one's force over twice the
  // move is a quarter of the mode's stiffness 4 k.
  constexpr int n = 401;
  constexpr double d = 1, kappa = 60, move = 1e-6;
  const double pull = magnetic::contact_pull(1, 1, d);
  const double spacing = d * (1 - std::log(magnetic::chain_load) / kappa);  // push = load
  const auto force = [&](double s) {
    const auto at = [&](int k) { return k * spacing + (k % 2 == 0 ? s : -s); };
    double sum = 0;
    for (int k = -n; k <= n; ++k) {
      if (k == 0) continue;
      const Vec3 r{0, 0, at(0) - at(k)};
      sum += magnetic::dipole_dipole({0, 0, 1}, {0, 0, 1}, r).on_j.z;
      if (std::abs(k) == 1) sum += magnetic::soft_repulsion(pull, kappa, d, r).on_j.z;
    }
    return sum;
  };
  const double mode = -(force(move) - force(-move)) / (2 * move);
  constexpr double tolerance = 0.02;  // the chain is 0.3 % shorter than touching carriers
  EXPECT_NEAR(mode / (4 * magnetic::soft_stiffness(pull, kappa, d)), 1, tolerance);
}

TEST(Dipoles, SubStepsFollowTheStiffness) {
  EXPECT_EQ(magnetic::contact_substeps(0), 1);
  EXPECT_EQ(magnetic::contact_substeps(0.25), 1);
  EXPECT_EQ(magnetic::contact_substeps(0.26), 2) << "faster than a step: never one alone";
  EXPECT_EQ(magnetic::contact_substeps(1), 2);
  EXPECT_EQ(magnetic::contact_substeps(1.01), 3);
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
