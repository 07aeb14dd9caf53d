// Shapes other than the red cell's, and networks that are at rest on another shape.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "membrane/mesh.hpp"
#include "membrane/rest_shape.hpp"
#include "membrane/stress_free.hpp"
#include "membrane/topology.hpp"

namespace hemomag::membrane {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double quadrature = 1e-9;  // Simpson's rule of rest_shape.cpp
constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();

/// Area of an oblate spheroid: 2 pi a^2 (1 + (1 - e^2)/e artanh e), e^2 = 1 - (c/a)^2.
double oblate_area(double diameter, double thickness) {
  const double a = diameter / 2, e = std::sqrt(1 - std::pow(thickness / diameter, 2));
  return 2 * pi * a * a * (1 + (1 - e * e) / e * std::atanh(e));
}

TEST(Spheroid, AreaVolumeAndHeightAreThoseOfTheClosedForms) {
  EXPECT_NEAR(rest_area(spheroid(10, 10)), 100 * pi, quadrature * 100 * pi);
  EXPECT_NEAR(rest_volume(spheroid(10, 10)), 1000 * pi / 6, round_off * 1000);
  for (const double thickness : {0.5, 1.0, 1.8}) {
    const RestShape body = spheroid(2.5, thickness);
    EXPECT_NEAR(rest_area(body), oblate_area(2.5, thickness), quadrature * 10);
    EXPECT_NEAR(rest_volume(body), pi / 6 * 2.5 * 2.5 * thickness, round_off * 10);
    EXPECT_NEAR(rest_height(body, 0), thickness / 2, round_off);
    EXPECT_NEAR(rest_height(body, 0.75), thickness / 2 * 0.8, round_off);  // sqrt(1 - 0.36)
  }
}

TEST(Spheroid, TheTableInvertsTheAreaFraction) {
  // On a sphere the area above a height is linear in it (Archimedes), and so is the table.
  const CosineOfAreaFraction sphere(spheroid(1, 1));
  for (const double f : {0.0, 0.1, 0.37, 0.5, 1.0}) EXPECT_NEAR(sphere(f), 1 - 2 * f, quadrature);
  const RestShape cell = red_cell_shape(7.82);
  const CosineOfAreaFraction inverse(cell);
  double worst = 0;
  for (int k = 0; k <= 100; ++k) {
    const double w = 1 - 0.0197 * k;  // between the rows of the table
    worst = std::max(worst, std::fabs(inverse(rest_area_fraction_above(cell, w)) - w));
  }
  std::printf("cosine of the area fraction: error %.2g, tolerance 1e-6\n", worst);
  EXPECT_LT(worst, 1e-6);  // 2000 rows, linear between them: (1e-3)^2/8 times curvatures of order 1
}

struct Body {
  const char* name;
  RestShape shape;
  int vertices;
};

class EvenedMesh : public testing::TestWithParam<Body> {};

TEST_P(EvenedMesh, IsWithinTheGatesAndHasTheVolumeOfTheShape) {
  const auto [name, shape, vertices] = GetParam();
  for (const std::uint64_t seed : {1, 2, 3}) {
    const TriangleMesh mesh = evened_mesh(shape, vertices, seed);
    ASSERT_EQ(static_cast<int>(mesh.x.size()), vertices);
    const MeshQuality q = quality(mesh);
    EXPECT_LE(q.mean_edge_ratio, MeshGates::mean_edge_ratio);
    EXPECT_LE(q.worst_edge_ratio, MeshGates::worst_edge_ratio);
    EXPECT_GE(q.smallest_angle, MeshGates::smallest_angle);
    EXPECT_GE(q.min_valence, MeshGates::min_valence);
    EXPECT_LE(q.max_valence, MeshGates::max_valence);
    const double area = surface_area(mesh) / rest_area(shape) - 1;
    std::printf("%s, %d vertices: area %+.2g off\n", name, vertices, area);
    EXPECT_NEAR(enclosed_volume(mesh) / rest_volume(shape), 1, 1e-10);  // solved for
    EXPECT_LT(std::fabs(area), 3.0 / vertices + (vertices < 300 ? 0.01 : 0.0));
    EXPECT_EQ(static_cast<int>(mesh.triangles.size()), 2 * vertices - 4) << "a sphere's topology";
  }
}

// A platelet's rim has a radius of curvature of 0.2 um, less than an edge of 0.3 um at 162
// vertices, hence another 1 % there.
INSTANTIATE_TEST_SUITE_P(Bodies, EvenedMesh,
                         testing::Values(Body{"platelet", spheroid(2.5, 1), 162},
                                         Body{"platelet", spheroid(2.5, 1), 642},
                                         Body{"flat platelet", spheroid(2.5, 0.5), 162},
                                         Body{"white", spheroid(10, 10), 162},
                                         Body{"white", spheroid(10, 10), 1442}),
                         [](const auto& info) { return "Body" + std::to_string(info.index); });

TEST(StressFree, OnTheCellsOwnShapeTheNetworkIsAtRest) {
  const RestShape cell = red_cell_shape(7.82);
  const TriangleMesh mesh = red_cell_mesh(642, 7.82, 1);
  const auto edges = topology(mesh).edges;
  const Prestress p = prestress(mesh, edges, stress_free_lengths(mesh, edges, cell, cell));
  std::printf("own shape: mean %.2g, largest %.2g\n", p.mean, p.largest);
  // The vertices stand off the surface by edge^2/8 times the mean curvature, by which edges differ:
  // offset times curvature is 20 nm times 0.9/um at the rim.
  EXPECT_LT(p.largest, 0.02);
  EXPECT_LT(p.mean, 0.005);
}

TEST(StressFree, TheRimIsStretchedAsTheMapSaysAndTrianglesKeepTheirArea) {
  const RestShape cell = red_cell_shape(7.82), sphere = spheroid(1, 1);
  const TriangleMesh mesh = red_cell_mesh(3286, 7.82, 1);
  const auto edges = topology(mesh).edges;
  const auto rest = stress_free_lengths(mesh, edges, cell, sphere);
  const Prestress p = prestress(mesh, edges, rest);
  // At the rim a parallel has 7.82 um on the cell and the sphere's diameter on the sphere; nowhere
  // is the stretch larger, and the meridians shorten by as much.
  const double stretch = 7.82 / std::sqrt(rest_area(cell) / pi);
  std::printf("on a sphere: l/l0 at most %.4f, expected %.4f; |l/l0 - 1| %.4f in the mean\n",
              p.longest, stretch, p.mean);
  EXPECT_NEAR(p.longest, stretch, 0.002);  // no edge is exactly on the rim and along it
  EXPECT_LT(p.largest, stretch - 1 + 0.002);

  // Heron's formula gives the triangles at their stress-free lengths.
  const auto rest_of = [&](int a, int b) {
    const Edge wanted{std::min(a, b), std::max(a, b)};
    const auto at =
        std::lower_bound(edges.begin(), edges.end(), wanted, [](const Edge& u, const Edge& v) {
          return u.a < v.a || (u.a == v.a && u.b < v.b);
        });
    return rest[static_cast<std::size_t>(at - edges.begin())];
  };
  double all = 0, worst = 0;
  for (const auto& t : mesh.triangles) {
    const double u = rest_of(t[0], t[1]), v = rest_of(t[1], t[2]), w = rest_of(t[2], t[0]);
    const double s = (u + v + w) / 2, area = std::sqrt(s * (s - u) * (s - v) * (s - w));
    const Vec3& o = mesh.x[static_cast<std::size_t>(t[0])];
    const double now = 0.5 * norm(cross(mesh.x[static_cast<std::size_t>(t[1])] - o,
                                        mesh.x[static_cast<std::size_t>(t[2])] - o));
    all += area;
    worst = std::max(worst, std::fabs(area / now - 1));
  }
  EXPECT_NEAR(all / surface_area(mesh), 1, round_off * 100) << "scaled to the area of the mesh";
  std::printf("largest change of a triangle's area %.3g\n", worst);
  // A triangle of finite size on a map whose stretch varies by its gradient (0.1/um) times the edge
  // (0.3 um).
  EXPECT_LT(worst, 0.03);
}

TEST(StressFree, TheNearerTheSphereTheLargerThePrestress) {
  const RestShape cell = red_cell_shape(7.82);
  const TriangleMesh mesh = red_cell_mesh(642, 7.82, 1);
  const auto edges = topology(mesh).edges;
  double before = 1;
  for (const double aspect : {1.0, 0.9, 0.8, 0.6}) {
    const double mean =
        prestress(mesh, edges, stress_free_lengths(mesh, edges, cell, spheroid(1, aspect))).mean;
    EXPECT_LT(mean, before) << aspect;
    before = mean;
  }
  // Lengths are ratios: neither the reference's size nor the unit matters.
  const auto one = stress_free_lengths(mesh, edges, cell, spheroid(1, 0.9));
  const auto two = stress_free_lengths(mesh, edges, cell, spheroid(3, 2.7));
  for (std::size_t e = 0; e < one.size(); ++e) EXPECT_NEAR(one[e], two[e], round_off * 8);
}

}  // namespace
}  // namespace hemomag::membrane
