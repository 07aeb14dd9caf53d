// Profiles across the channel and the cell-free layer on shapes whose answers are known.
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "analysis/apparent_viscosity.hpp"
#include "analysis/cell_free_layer.hpp"
#include "analysis/profiles.hpp"
#include "support/shapes.hpp"

namespace {

using namespace hemomag;
using analysis::SurfaceTriangle;
using std::numbers::pi;

constexpr double round_off = 1e-12;  // sums of up to 5,120 triangles of order 1

std::vector<SurfaceTriangle> placed(const test::Surface& s, const Vec3& shift) {
  std::vector<SurfaceTriangle> triangles;
  for (const auto& t : s.triangles) {
    SurfaceTriangle out{};
    for (std::size_t k = 0; k < 3; ++k) {
      out.x[k] = s.points[static_cast<std::size_t>(t[k])] + shift;
      out.tag[k] = t[k];
    }
    triangles.push_back(out);
  }
  return triangles;
}

test::Surface box(const Vec3& side) {
  test::Surface s = test::cube(1);
  for (Vec3& x : s.points) x = {side.x * x.x, side.y * x.y, side.z * x.z};
  return s;
}

double mesh_volume(const std::vector<SurfaceTriangle>& triangles) {
  double v = 0;
  for (const auto& t : triangles) v += dot(t.x[0], cross(t.x[1], t.x[2])) / 6;
  return v;
}

TEST(EnclosedVolume, OfABoxFillsTheSlabsItCovers) {
  // From z = 1.25 to 4.25 in slabs of one: 3/4, 1, 1, 1/4 of the base area.
  std::vector<double> volume(6, 0.0);
  add_enclosed_volume(placed(box({2, 5, 3}), {-7, 3, 1.25}), 1.0, volume);
  const double expected[] = {0, 7.5, 10, 10, 2.5, 0};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(volume[k], expected[k], 10 * round_off) << k;
}

TEST(EnclosedVolume, OfASphereIsThatOfItsZones) {
  // Zone of a sphere: pi (R^2 h - (b^3 - a^3)/3) between a and b from the centre. The mesh of 5,120
  // triangles holds 0.25 % less than the sphere.
  constexpr double R = 3, middle = 4.3, h = 0.5;
  std::vector<double> volume(18, 0.0);
  const auto triangles = placed(test::icosphere(R, 4), {1, 2, middle});
  add_enclosed_volume(triangles, h, volume);
  double sum = 0;
  for (std::size_t k = 0; k < volume.size(); ++k) {
    const double a = std::clamp(static_cast<double>(k) * h - middle, -R, R),
                 b = std::clamp(static_cast<double>(k + 1) * h - middle, -R, R);
    EXPECT_NEAR(volume[k], pi * (R * R * (b - a) - (b * b * b - a * a * a) / 3), 0.05) << k;
    sum += volume[k];
  }
  EXPECT_NEAR(sum, mesh_volume(triangles), 1e3 * round_off);  // volumes of order 100
}

TEST(EnclosedVolume, AddsUpOverPartsAndDoesNotCareAboutPeriodicImages) {
  auto triangles = placed(test::torus(3, 1, 32, 16), {0, 0, 2.1});
  std::vector<double> whole(9, 0.0), parts(9, 0.0);
  add_enclosed_volume(triangles, 0.5, whole);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (Vec3& x : triangles[t].x) x += Vec3{20.0 * double(t % 3), -10.0 * double(t % 2), 0};
  const std::span all(triangles);
  add_enclosed_volume(all.first(100), 0.5, parts);
  add_enclosed_volume(all.subspan(100), 0.5, parts);
  for (std::size_t k = 0; k < whole.size(); ++k)
    EXPECT_NEAR(whole[k], parts[k], 1e3 * round_off) << k;
}

TEST(HalfCoreHeight, IsWhereTheProfileReachesHalfItsCore) {
  // 0, 0.1, 0.3 and then 0.4: half the core, 0.2, is reached half-way between the second and the
  // third slab.
  const std::vector<double> ht{0, 0.1, 0.3, 0.4, 0.4, 0.4, 0.4, 0.4, 0.4, 0.4, 0.3, 0.1};
  EXPECT_NEAR(analysis::half_core_height(ht, 2.0), 4.0, round_off);
  EXPECT_EQ(analysis::half_core_height(std::vector<double>(8, 0.3), 1.0), 0);
  EXPECT_EQ(analysis::half_core_height(std::vector<double>(8, 0.0), 1.0), 4);
}

TEST(CellFreeLayer, UnderASlabIsItsDistanceFromEitherPlate) {
  // A slab over the whole plane from z = 2 to 7 in a channel 10 high, shifted across the borders.
  analysis::FacingSurfaces facing({6, 4, 10}, 0.5);
  facing.add(placed(box({6, 4, 5}), {2.3, -9.1, 2}));
  EXPECT_NEAR(facing.layer(0).mean, 2, round_off);
  EXPECT_NEAR(facing.layer(0).seen, 2, round_off);
  EXPECT_NEAR(facing.layer(1).mean, 3, round_off);
}

TEST(CellFreeLayer, ColumnsWithoutACellCountHalfTheHeight) {
  // A block over half of the length along y and a third of the width along x.
  analysis::FacingSurfaces facing({6, 4, 10}, 0.25);
  facing.add(placed(box({2, 2, 3}), {1, 1, 1}));
  EXPECT_NEAR(facing.layer(0).mean, 5 * 5. / 6 + 1 * 1. / 6, round_off);
  EXPECT_NEAR(facing.layer(0).seen, 0.5 * 5 + 0.5 * 1, round_off);
  EXPECT_NEAR(facing.layer(1).mean, 5, round_off);  // its upper side is below the middle
  facing.clear();
  EXPECT_EQ(facing.layer(0).mean, 5);
}

TEST(CellFreeLayer, UnderASphereIsTheMeanOfItsLowerHalf) {
  // Over the disc of the sphere: c - 2/3 R in the mean; elsewhere half the height.
  constexpr double R = 3, c = 4, H = 12, L = 8;
  analysis::FacingSurfaces facing({L, L, H}, 0.05);
  facing.add(placed(test::icosphere(R, 5), {1, 7, c}));
  const double disc = pi * R * R / (L * L);
  EXPECT_NEAR(facing.layer(0).mean, disc * (c - 2 * R / 3) + (1 - disc) * H / 2, 0.01);
  // Seen along x it covers 2 R of the length, at c - pi/4 R in the mean.
  const double covered = 2 * R / L;
  EXPECT_NEAR(facing.layer(0).seen, covered * (c - pi / 4 * R) + (1 - covered) * H / 2, 0.02);
}

TEST(ApparentViscosity, OfAUniformFluidIsItsOwn) {
  constexpr double eta = 0.17, H = 24, shear = 1e-3, g = 2e-6;
  analysis::PlateFlow couette{{eta * shear, -eta * shear}, {0, shear * H}, H, shear * H / 2};
  EXPECT_NEAR(apparent_viscosity_couette(couette), eta, eta * round_off);
  analysis::PlateFlow driven{{g * H / 2, g * H / 2}, {0, 0}, H, g * H * H / (12 * eta)};
  EXPECT_NEAR(apparent_viscosity_poiseuille(driven), eta, eta * round_off);
}

TEST(Moments, AreTheMeanAndTheStandardDeviation) {
  analysis::Moments m;
  for (const double v : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) m.add(std::array{v, -v});
  EXPECT_EQ(m.count(), 8);
  EXPECT_NEAR(m.mean(0), 5, round_off);
  EXPECT_NEAR(m.mean(1), -5, round_off);
  EXPECT_NEAR(m.deviation(0), std::sqrt(32.0 / 7), round_off);
}

}  // namespace
