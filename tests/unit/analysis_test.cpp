// Margination counts and the inside test against brute force.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "analysis/inside.hpp"
#include "analysis/margination.hpp"
#include "membrane/mesh.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;

TEST(Margination, CountsTheLayerNextToOneOrBothPlates) {
  const std::vector<double> z{0.5, 2.8, 3, 12, 21.3, 23};
  EXPECT_EQ(analysis::in_layer(z, 2.8, 24, analysis::LayerWalls::lower), 2);
  EXPECT_EQ(analysis::in_layer(z, 2.8, 24, analysis::LayerWalls::both), 4);
}

TEST(Margination, IsEquation46) {
  EXPECT_DOUBLE_EQ(analysis::margination_probability(18, 18, 60), 0);
  EXPECT_DOUBLE_EQ(analysis::margination_probability(60, 18, 60), 1);
  EXPECT_DOUBLE_EQ(analysis::margination_probability(39, 18, 60), 0.5);
  EXPECT_DOUBLE_EQ(analysis::margination_probability(8, 10, 60), -0.04);
  EXPECT_DOUBLE_EQ(analysis::margination_probability(60, 60, 60), 0);
}

/// Solid angle of all triangles over 4 pi, the independent answer.
double winding(const Vec3& p, const membrane::TriangleMesh& mesh, const Vec3& shift) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.x[static_cast<std::size_t>(t[0])] + shift - p,
               b = mesh.x[static_cast<std::size_t>(t[1])] + shift - p,
               c = mesh.x[static_cast<std::size_t>(t[2])] + shift - p;
    sum += 2 * std::atan2(dot(a, cross(b, c)), norm(a) * norm(b) * norm(c) + dot(a, b) * norm(c) +
                                                   dot(b, c) * norm(a) + dot(c, a) * norm(b));
  }
  return sum / (4 * std::numbers::pi);
}

TEST(Inside, EqualsTheSolidAngleAcrossPeriodicBorders) {
  const auto mesh = membrane::red_cell_mesh(642, 16, 5);
  test::Random random(11);
  for (const bool periodic_z : {false, true})
    for (const Vec3& centre : {Vec3{10, 10, 10}, Vec3{0.5, 19.5, 4}}) {
      const analysis::ChannelBox box{{20, 20, 20}, periodic_z};
      std::vector<analysis::SurfaceTriangle> triangles;
      for (const auto& t : mesh.triangles) {
        analysis::SurfaceTriangle s;
        for (std::size_t k = 0; k < 3; ++k) {
          s.x[k] = mesh.x[static_cast<std::size_t>(t[k])] + centre;
          s.tag[k] = t[k];
        }
        triangles.push_back(s);
      }
      std::vector<Vec3> points;
      for (int k = 0; k < 400; ++k) points.push_back(random.in_cube(10) + Vec3{10, 10, 10});
      const auto times = analysis::enclosure(points, triangles, box);
      int inside = 0;
      for (std::size_t k = 0; k < points.size(); ++k) {
        double expected = 0;
        for (int i = -1; i <= 1; ++i)
          for (int j = -1; j <= 1; ++j)
            for (int l = periodic_z ? -1 : 0; l <= (periodic_z ? 1 : 0); ++l)
              expected += winding(points[k], mesh, centre + Vec3{20. * i, 20. * j, 20. * l});
        EXPECT_EQ(times[k], std::lround(expected))
            << points[k].x << " " << points[k].y << " " << points[k].z;
        inside += times[k];
      }
      EXPECT_GT(inside, 5);
    }
}

TEST(Inside, ARayThroughAVertexOrEdgeCountsOnce) {
  // A cube whose corners lie exactly above and below the points.
  std::vector<analysis::SurfaceTriangle> cube;
  const auto corner = [](int k) {
    return Vec3{1. + 2 * (k & 1), 1. + (k & 2), 1. + 2 * (k >> 2 & 1)};
  };
  const int faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                            {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (const auto& f : faces)
    cube.push_back({{corner(f[0]), corner(f[1]), corner(f[2])}, {f[0] + 1, f[1] + 1, f[2] + 1}});
  const std::vector<Vec3> points{
      {2, 2, 2}, {2, 2, 0.5}, {2, 2, 3.5}, {1.5, 2.5, 2}};  // the first three lie on the diagonals
  const auto times = analysis::enclosure(points, cube, {{10, 10, 10}, false});
  EXPECT_EQ(times, (std::vector<int>{1, 0, 0, 1}));
}

}  // namespace
