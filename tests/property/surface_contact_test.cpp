// Distances of triangles, their exact crossing, and the repulsion of a point from a triangle.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "contact/surface_repulsion.hpp"
#include "lattice/surface_gaps.hpp"
#include "lattice/triangle_crossing.hpp"
#include "lattice/triangle_distance.hpp"
#include "support/gradient.hpp"
#include "support/shapes.hpp"

namespace {

using namespace hemomag;
using lattice::GridPoint;
using lattice::GridTriangle;
using lattice::Triangle;

Triangle random_triangle(test::Random& random, double half) {
  return {random.in_cube(half), random.in_cube(half), random.in_cube(half)};
}

/// Nearest point by search: a net of barycentric coordinates, narrowed about the best.
double searched_distance(const Vec3& p, const Triangle& t) {
  double u0 = 0.5, v0 = 0.5, width = 1, least = 1e300;
  for (int round = 0; round < 60; ++round, width *= 0.6) {
    double best_u = u0, best_v = v0;
    for (int i = -4; i <= 4; ++i)
      for (int j = -4; j <= 4; ++j) {
        const double u = std::clamp(u0 + i * width / 8, 0.0, 1.0);
        const double v = std::clamp(v0 + j * width / 8, 0.0, 1.0 - u);
        const double d = norm(p - (t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0])));
        if (d < least) least = d, best_u = u, best_v = v;
      }
    u0 = best_u, v0 = best_v;
  }
  return least;
}

TEST(TriangleDistance, TheNearestPointIsTheOneASearchFinds) {
  test::Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const Triangle t = random_triangle(random, 1);
    const Vec3 p = random.in_cube(2);
    const auto foot = lattice::nearest_point(p, t);
    EXPECT_NEAR(norm(p - foot.x), searched_distance(p, t), 1e-6) << k;
    Vec3 again;
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_GE(foot.weight[c], -1e-15);
      again += foot.weight[c] * t[c];
    }
    EXPECT_NEAR(foot.weight[0] + foot.weight[1] + foot.weight[2], 1, 1e-14);
    EXPECT_LT(norm(again - foot.x), 1e-13);
  }
}

TEST(TriangleDistance, OfTwoTrianglesIsTheLeastOverTheirPoints) {
  test::Random random(2);
  for (int k = 0; k < 300; ++k) {
    const Triangle s = random_triangle(random, 1);
    Triangle t = random_triangle(random, 1);
    for (Vec3& p : t) p.x += 2.2;
    double least = 1e300;
    constexpr int n = 60;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Vec3 p = s[0] + (1.0 * i / n) * (s[1] - s[0]) + (1.0 * j / n) * (s[2] - s[0]);
        least = std::min(least, norm(p - lattice::nearest_point(p, t).x));
      }
    const double d = std::sqrt(lattice::triangle_distance2(s, t));
    EXPECT_LE(d, least + 1e-12) << k;
    EXPECT_GT(d, least - 0.05) << "the net's width " << k;
  }
  const Triangle a{Vec3{0, -1, 0}, Vec3{0, 1, 0}, Vec3{-9, 0, 0}};
  const Triangle b{Vec3{0.3, 0, -1}, Vec3{0.3, 0, 1}, Vec3{9, 0, 0}};
  EXPECT_DOUBLE_EQ(lattice::triangle_distance2(a, b), 0.09) << "edge against edge";
}

/// Points over the face, beyond every edge and every corner, on both sides.
TEST(SurfaceRepulsion, ForcesAreMinusTheGradientInEveryRegion) {
  const contact::SurfaceRepulsion law{3, 0.8};
  const Triangle t{Vec3{0.1, 0, 0}, Vec3{1, 0.2, 0.1}, Vec3{0.3, 0.9, -0.1}};
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]) / norm(cross(t[1] - t[0], t[2] - t[0]));
  const Vec3 middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
  for (std::size_t c = 0; c < 3; ++c)
    for (const double height : {0.3, 0.05, -0.2})
      for (const int region : {0, 1, 2}) {
        const Vec3 mid_edge = 0.5 * (t[c] + t[(c + 1) % 3]);
        const Vec3 beside = region == 0   ? middle + 0.2 * (t[c] - middle)
                            : region == 1 ? mid_edge + 0.5 * (mid_edge - middle)
                                          : t[c] + 0.4 * (t[c] - middle);
        const std::vector<Vec3> x{beside + height * normal, t[0], t[1], t[2]};
        const auto at = contact::point_triangle(x[0], {x[1], x[2], x[3]});
        int on = 0;
        for (const double w : at.weight) on += w > 0;
        EXPECT_EQ(on, 3 - region) << "face, edge, corner";
        EXPECT_EQ(at.distance < 0, height < 0);
        ASSERT_LT(at.distance, law.range);
        const auto f = contact::forces(at, contact::force(law, at.distance));
        const std::vector<Vec3> F{f.point, f.corner[0], f.corner[1], f.corner[2]};
        EXPECT_LT(test::gradient_error(
                      x, F, 0.02,
                      [&](const std::vector<Vec3>& y) {
                        return contact::energy(
                            law, contact::point_triangle(y[0], {y[1], y[2], y[3]}).distance);
                      }),
                  1e-7)
            << c << " " << height << " " << region;
        Vec3 sum, torque;
        for (std::size_t k = 0; k < 4; ++k) sum += F[k], torque += cross(x[k], F[k]);
        EXPECT_LT(norm(sum), 1e-14);
        EXPECT_LT(norm(torque), 1e-14);
      }
}

TEST(SurfaceRepulsion, IsZeroBeyondItsRangeAndPushesOutFromWithin) {
  const contact::SurfaceRepulsion law{2, 0.5};
  EXPECT_EQ(contact::force(law, 0.5), 0);
  EXPECT_EQ(contact::energy(law, 0.7), 0);
  EXPECT_DOUBLE_EQ(contact::force(law, -0.5), 2);
  const Triangle t{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  const auto inside = contact::point_triangle({0.2, 0.2, -0.1}, t);
  EXPECT_DOUBLE_EQ(inside.distance, -0.1);
  EXPECT_EQ(inside.outward.z, 1);
  EXPECT_EQ(contact::point_triangle({0.2, 0.2, 0}, t).outward.z, 1) << "on the triangle";
}

// ---- crossing

GridTriangle moved(GridTriangle t, const GridPoint& by) {
  for (auto& p : t)
    for (std::size_t d = 0; d < 3; ++d) p[d] += by[d];
  return t;
}

const GridTriangle flat{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}};

TEST(TriangleCrossing, ConstructedCases) {
  const auto cross = [](const GridTriangle& a, const GridTriangle& b) {
    const bool once = lattice::triangles_cross(a, b);
    EXPECT_EQ(once, lattice::triangles_cross(b, a)) << "symmetric";
    const GridTriangle turned{{b[1], b[2], b[0]}}, mirrored{{b[0], b[2], b[1]}};
    EXPECT_EQ(once, lattice::triangles_cross(a, turned)) << "in any order of corners";
    EXPECT_EQ(once, lattice::triangles_cross(a, mirrored)) << "and sense";
    return once;
  };
  EXPECT_TRUE(cross(flat, {{{2, 2, -5}, {3, 2, 5}, {2, 3, 5}}})) << "pierced";
  EXPECT_FALSE(cross(flat, {{{2, 2, 1}, {3, 2, 5}, {2, 3, 5}}})) << "above";
  EXPECT_TRUE(cross(flat, {{{2, 2, 0}, {3, 2, 5}, {2, 3, 5}}})) << "a corner touches";
  EXPECT_FALSE(cross(flat, {{{6, 6, -5}, {9, 9, 5}, {9, 8, 5}}})) << "beside, through the plane";
  EXPECT_TRUE(cross(flat, {{{-5, -5, -5}, {13, 13, 5}, {-9, 20, 0}}})) << "edge through the face";
  EXPECT_TRUE(cross(flat, {{{5, 5, -5}, {5, 5, 5}, {9, 9, 0}}})) << "edge touches edge";
  EXPECT_TRUE(cross(flat, flat)) << "the same";
  EXPECT_TRUE(cross(flat, {{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}})) << "one within the other, flat";
  EXPECT_TRUE(cross(flat, moved(flat, {5, 0, 0}))) << "overlap in the plane";
  EXPECT_TRUE(cross(flat, moved(flat, {10, 0, 0}))) << "a corner on a corner";
  EXPECT_FALSE(cross(flat, moved(flat, {11, 0, 0}))) << "apart in the plane";
  EXPECT_FALSE(cross(flat, moved(flat, {0, 0, 1}))) << "parallel";
  EXPECT_FALSE(cross(flat, {{{8, 8, 0}, {9, 8, 0}, {8, 9, 0}}})) << "in the box, not the triangle";
  EXPECT_TRUE(cross(flat, {{{2, 2, -5}, {2, 2, 5}, {2, 2, 5}}})) << "a segment pierces";
  EXPECT_FALSE(cross(flat, {{{20, 2, -5}, {20, 2, 5}, {20, 2, 5}}}));
}

/// Whether an edge of one passes through the face of the other, by its parameter and barycentric
/// coordinates in floating point.
/// @param margin  how far the nearest of them is from its limit: below some eps nothing is sure
bool pierced(const Triangle& s, const Triangle& t, double& margin) {
  margin = 1e300;
  bool any = false;
  const auto edges = [&](const Triangle& a, const Triangle& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = a[k], d = a[(k + 1) % 3] - a[k];
      const Vec3 n = cross(b[1] - b[0], b[2] - b[0]);
      const double u = dot(n, b[0] - p) / dot(n, d);
      const Vec3 q = p + u * d - b[0];
      const double n2 = norm2(n), v = dot(cross(q, b[2] - b[0]), n) / n2,
                   w = dot(cross(b[1] - b[0], q), n) / n2;
      const double inside = std::min({u, 1 - u, v, w, 1 - v - w});
      margin = std::min(margin, std::fabs(inside));
      any = any || inside > 0;
    }
  };
  edges(s, t);
  edges(t, s);
  return any;
}

TEST(TriangleCrossing, RandomTrianglesAgreeWithFloatingPointWhereThatIsSure) {
  test::Random random(3);
  int crossing = 0, compared = 0;
  for (int k = 0; k < 20000; ++k) {
    const Triangle s = random_triangle(random, 1), t = random_triangle(random, 1);
    double margin = 0;
    const bool expected = pierced(s, t, margin);
    if (margin < 1e-9) continue;
    const auto grid = [](const Triangle& a) {
      GridTriangle g;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t d = 0; d < 3; ++d)
          g[i][d] = std::llround(a[i][d] * 0.25 * double(lattice::largest_grid_difference));
      return g;
    };
    EXPECT_EQ(lattice::triangles_cross(grid(s), grid(t)), expected) << k;
    crossing += expected;
    ++compared;
  }
  EXPECT_GT(compared, 19000);
  EXPECT_GT(crossing, 1000);
}

TEST(TriangleCrossing, OneUnitApartIsDecidedAtTheFullRangeOfTheGrid) {
  const std::int64_t big = lattice::largest_grid_difference / 2 - 2;
  // A slanted plane through three far points, and points one unit to either side of it.
  const GridTriangle plane{{{-big, -big, -big}, {big, -big, 0}, {-big, big, big - 1}}};
  // On the middle of the first edge, which is a grid point.
  const GridPoint on{0, -big, -big / 2};
  ASSERT_EQ(2 * on[2], plane[0][2] + plane[1][2]);
  for (const int off : {0, 1}) {
    const GridTriangle above{
        {{on[0], on[1], on[2] + off}, {on[0], on[1] + 1, big}, {on[0] + 1, on[1], big}}};
    EXPECT_EQ(lattice::triangles_cross(plane, above), off == 0) << off;
  }
}

lattice::SurfaceView view(const lattice::Surface& s) { return {s.points, s.triangles}; }

TEST(SurfaceGaps, OfSpheresAcrossThePeriodAndNested) {
  auto a = test::icosphere(1, 3), b = a;
  for (Vec3& p : b.points) p += Vec3{2.3, 0, 0};
  const lattice::PeriodicBox box{{5, 6, 6}};
  const std::vector<lattice::SurfaceView> both{view(a), view(b)};
  auto gaps = lattice::surface_gaps(both, box, 1);
  EXPECT_EQ(gaps.crossings, 0);
  EXPECT_NEAR(gaps.smallest, 0.3, 1e-3) << "2.7 the other way round";
  for (Vec3& p : b.points) p += Vec3{0.55, 0, 0};  // 2.15 to the image of a
  gaps = lattice::surface_gaps(both, box, 1);
  EXPECT_NEAR(gaps.smallest, 0.15, 1e-3);
  for (Vec3& p : b.points) p += Vec3{10.2, 0, 0};  // 1.95 to it: they cross
  gaps = lattice::surface_gaps(both, box, 1);
  EXPECT_GT(gaps.crossings, 0);
  EXPECT_EQ(gaps.smallest, 0);
  const std::vector<lattice::SurfaceView> one{view(a)};
  EXPECT_TRUE(std::isinf(lattice::surface_gaps(one, box, 1).smallest));
  EXPECT_NEAR(lattice::surface_gaps(one, {{2.4, 6, 6}}, 1).smallest, 0.4, 1e-3) << "its own image";
  EXPECT_GT(lattice::surface_gaps(one, {{1.99, 6, 6}}, 0.3).crossings, 0);
}

TEST(SurfaceGaps, ASurfaceThatCutsItselfIsSeen) {
  auto a = test::icosphere(1, 3);
  EXPECT_EQ(lattice::surface_gaps(std::vector{view(a)}, {{9, 9, 9}}, 0.1).crossings, 0);
  for (Vec3& p : a.points)
    if (p.z > 0.8) p.z -= 2.5;  // the cap is pushed out below
  EXPECT_GT(lattice::surface_gaps(std::vector{view(a)}, {{9, 9, 9}}, 0.1).crossings, 0);
}

/// Every pair of triangles and of 27 images, without bins.
TEST(SurfaceGaps, RandomBallsAgreeWithEveryPairCompared) {
  test::Random random(5);
  const lattice::PeriodicBox box{{4, 5, 4}, {true, true, false}};
  for (int k = 0; k < 12; ++k) {
    std::vector<lattice::Surface> balls;
    for (int n = 0; n < 3; ++n) {
      balls.push_back(test::icosphere(0.6, 1));
      const Vec3 at{random.uniform(-4, 8), random.uniform(-5, 10), random.uniform(0, 4)};
      for (Vec3& p : balls.back().points) p += at;
    }
    std::vector<lattice::SurfaceView> views;
    for (const auto& b : balls) views.push_back(view(b));
    long crossings = 0;
    double least = 1;
    const double quantum = 1e-9;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = a + 1; b < 3; ++b)
        for (int i = -4; i <= 4; ++i)
          for (int j = -4; j <= 4; ++j)
            for (const auto& s : balls[a].triangles)
              for (const auto& t : balls[b].triangles) {
                Triangle x, y;
                GridTriangle gx, gy;
                for (std::size_t c = 0; c < 3; ++c) {
                  x[c] = balls[a].points[std::size_t(s[c])];
                  y[c] = balls[b].points[std::size_t(t[c])] + Vec3{4.0 * i, 5.0 * j, 0};
                  for (std::size_t d = 0; d < 3; ++d)
                    gx[c][d] = std::llround(x[c][d] / quantum),
                    gy[c][d] = std::llround(y[c][d] / quantum);
                }
                if (norm(x[0] - y[0]) > 3) continue;
                const bool cross = lattice::triangles_cross(gx, gy);
                crossings += cross;
                least = cross ? 0 : std::min(least, std::sqrt(lattice::triangle_distance2(x, y)));
              }
    const auto gaps = lattice::surface_gaps(views, box, 1);
    EXPECT_EQ(gaps.crossings, crossings) << k;
    if (least < 1) {
      EXPECT_NEAR(gaps.smallest, least, 1e-12) << k;
    }
  }
}

}  // namespace
