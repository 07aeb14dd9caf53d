// The vector loops over edges, triangles and hinges against the laws for one number at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "membrane/area_volume.hpp"
#include "membrane/mesh.hpp"
#include "membrane/network.hpp"
#include "membrane/topology.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;
using membrane::Spring;
using test::Random;

// Some 50 operations an element, on terms of the given scale.
constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
constexpr std::size_t elements = 10003;  // no multiple of any width

class Levels : public testing::TestWithParam<SimdLevel> {
  void SetUp() override {
    if (GetParam() > simd_level()) GTEST_SKIP() << "this processor has no " << name(GetParam());
  }
};
INSTANTIATE_TEST_SUITE_P(Network, Levels,
                         testing::Values(SimdLevel::sse2, SimdLevel::avx2, SimdLevel::avx512),
                         [](const auto& info) { return name(info.param); });

int at(std::size_t k) { return static_cast<int>(k); }

TEST_P(Levels, EdgeForcesAreThoseOfTheScalarLaw) {
  Random random(11);
  std::vector<Vec3> x, expected, f(2 * elements);
  std::vector<double> scale;
  membrane::EdgeList edges;
  for (std::size_t k = 0; k < elements; ++k) {
    const double m = k < elements / 3 ? 2 : 2.7;  // two runs
    const auto s = membrane::make_spring(random.uniform(0.3, 0.6), random.uniform(0.5, 3),
                                         random.uniform(0.001, 0.1), m);
    const Vec3 direction = random.in_cube(1) + Vec3{2, 0, 0};
    const double l = s.l_max * random.uniform(0.15, 0.9);
    x.push_back(random.in_cube(1));
    x.push_back(x.back() + (l / norm(direction)) * direction);
    const Vec3 d = x[2 * k] - x[2 * k + 1];
    const double length = norm(d);
    const Vec3 F = (-tension(s, length) / length) * d;
    expected.push_back(F);
    expected.push_back(-F);
    // x/l_max has the rounding of positions of size one; near l_max the force multiplies it.
    const double slack = 1 - length / s.l_max;
    scale.push_back((s.wlc * (1 / (slack * slack * slack) + 1) + s.k_p * m * std::pow(length, -m)) *
                    (1 + 1 / length));
    edges.add(at(2 * k), at(2 * k + 1), s);
  }
  edges.finish();
  EXPECT_EQ(edges.add_forces(x, f, GetParam()), -1);
  double worst = 0;
  for (std::size_t v = 0; v < x.size(); ++v)
    worst = std::max(worst, norm(f[v] - expected[v]) / scale[v / 2]);
  EXPECT_LT(worst, round_off);
}

TEST_P(Levels, AnEdgeAtItsLimitIsFoundWhereverItIs) {
  const Spring s = membrane::make_spring(0.45, 2, 0.01, 2);
  for (const std::ptrdiff_t bad : {0, 3, 7, 8, 12, 18})
    for (const double length : {2.0, 5.0, std::numeric_limits<double>::quiet_NaN()}) {
      membrane::EdgeList edges;
      std::vector<Vec3> x, f(38);
      for (std::ptrdiff_t k = 0; k < 19; ++k) {
        x.push_back({0, 0, 0});
        x.push_back({k == bad || k == 18 ? length : 1.0, 0, 0});
        edges.add(at(2 * static_cast<std::size_t>(k)), at(2 * static_cast<std::size_t>(k) + 1), s);
      }
      edges.finish();
      EXPECT_EQ(edges.add_forces(x, f, GetParam()), bad);
    }
}

TEST_P(Levels, TriangleForcesAndSumsAreThoseOfTheScalarLaw) {
  Random random(12);
  std::vector<Vec3> x, expected, f(3 * elements);
  std::vector<double> scale;
  membrane::TriangleList triangles;
  struct Cell {
    double area = 0, volume = 0, volume_scale = 0;
    membrane::TriangleList::Pull pull;
  };
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < elements; ++k) {
    if (k % 1237 == 0 || k == 5) {  // cells of many sizes, none a multiple of the width
      triangles.start_cell();
      cells.push_back({0, 0, 0, {random.uniform(-1, 1), random.uniform(-1, 1)}});
    }
    const Vec3 a = random.in_cube(1);
    x.insert(x.end(),
             {a, a + Vec3{1, 0, 0} + random.in_cube(0.3), a + Vec3{0, 1, 0} + random.in_cube(0.3)});
    const Vec3 unwrap{random.uniform(-9, 9), 0, random.uniform(-9, 9)};
    const double k_d = random.uniform(0.1, 2), area0 = random.uniform(0.2, 1);
    Cell& cell = cells.back();
    const Vec3 n = membrane::twice_area_vector(x[3 * k], x[3 * k + 1], x[3 * k + 2]);
    const double area = 0.5 * norm(n);
    cell.area += area;
    cell.volume += dot(x[3 * k + 1] + unwrap, n) / 6;
    cell.volume_scale += norm(x[3 * k + 1] + unwrap) * norm(n) / 6;
    const auto A = membrane::area_forces(x[3 * k], x[3 * k + 1], x[3 * k + 2], n / (2 * area),
                                         membrane::restoring(k_d, area, area0) + cell.pull.area);
    const auto V = membrane::volume_forces(n, cell.pull.volume);
    for (const Vec3& F : {A.a + V.a, A.b + V.b, A.c + V.c}) expected.push_back(F);
    scale.push_back(k_d * (1 + area / area0) + std::fabs(cell.pull.area) +
                    std::fabs(cell.pull.volume));
    triangles.add({at(3 * k), at(3 * k + 1), at(3 * k + 2)}, unwrap, k_d, area0);
  }
  triangles.finish();
  ASSERT_EQ(triangles.cells(), cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto g = triangles.geometry(c, x, GetParam());
    EXPECT_NEAR(g.area, cells[c].area, round_off * cells[c].area);
    EXPECT_NEAR(g.volume, cells[c].volume, round_off * cells[c].volume_scale);
    triangles.add_forces(c, cells[c].pull, x, f, GetParam());
  }
  double worst = 0;
  for (std::size_t v = 0; v < x.size(); ++v)
    worst = std::max(worst, norm(f[v] - expected[v]) / scale[v / 3]);
  EXPECT_LT(worst, round_off);
}

TEST_P(Levels, HingeForcesAreThoseOfTheScalarLawFlatAndConcaveIncluded) {
  Random random(13);
  std::vector<Vec3> x, expected, f(4 * elements);
  std::vector<double> scale;
  membrane::HingeList hinges;
  int flat = 0, concave = 0;
  for (std::size_t k = 0; k < elements; ++k) {
    const double theta = k % 10 == 0 ? 0.0 : random.uniform(-2.5, 2.5);
    const double s = std::sin(theta / 2), c = std::cos(theta / 2);
    Vec3 p[4] = {{-c, random.uniform(0.2, 0.8), -s},
                 {0, 0, 0},
                 {0, 1, 0},
                 {c, random.uniform(0.2, 0.8), -s}};
    if (k % 10 != 0)
      for (Vec3& corner : p) corner += random.in_cube(0.2);
    x.insert(x.end(), p, p + 4);
    const double theta0 = k % 20 == 0 ? 0.0 : random.uniform(-1, 1);
    const membrane::Bending law{random.uniform(0.1, 1), std::sin(theta0), std::cos(theta0)};
    const auto h = membrane::make_hinge(p[0], p[1], p[2], p[3]);
    const auto F = membrane::forces(law, h, p[0], p[1], p[3]);
    for (const Vec3& force : {F.f1, F.f2, F.f3, F.f4}) expected.push_back(force);
    scale.push_back(law.k_b * h.length * (1 / norm(h.n1) + 1 / norm(h.n2)) *
                    (1 + 1 / (h.length * h.length)));
    hinges.add({at(4 * k), at(4 * k + 1), at(4 * k + 2), at(4 * k + 3)}, law);
    flat += h.theta.sine == 0;
    concave += h.theta.sine < 0;
  }
  hinges.finish();
  EXPECT_GT(flat, 500);
  EXPECT_GT(concave, 2000);
  hinges.add_forces(x, f, GetParam());
  double worst = 0;
  for (std::size_t v = 0; v < x.size(); ++v)
    worst = std::max(worst, norm(f[v] - expected[v]) / scale[v / 4]);
  EXPECT_LT(worst, round_off);
}

TEST_P(Levels, ForcesOfAWholeCellVanishTogetherAndAddToWhatWasThere) {
  Random random(14);
  auto mesh = membrane::red_cell_mesh(642, 15.64, 1);
  for (Vec3& v : mesh.x) v += random.in_cube(0.05);
  const auto topology = membrane::topology(mesh);
  membrane::EdgeList edges;
  membrane::TriangleList triangles;
  membrane::HingeList hinges;
  for (const auto& e : topology.edges)
    edges.add(e.a, e.b, membrane::make_spring(0.45, 2.2, 0.01, 2));
  triangles.start_cell();
  for (const auto& t : mesh.triangles) triangles.add(t, {}, 0.1, 0.4);
  for (const auto& h : topology.hinges) hinges.add(h, {0.01, 0.1, std::sqrt(0.99)});
  edges.finish();
  triangles.finish();
  hinges.finish();
  const auto add_all = [&](std::vector<Vec3>& f) {
    EXPECT_EQ(edges.add_forces(mesh.x, f, GetParam()), -1);
    triangles.add_forces(0, {0.02, -0.03}, mesh.x, f, GetParam());
    hinges.add_forces(mesh.x, f, GetParam());
  };
  std::vector<Vec3> f(mesh.x.size()), again(mesh.x.size());
  add_all(f);
  add_all(again);
  EXPECT_TRUE(f == again) << "the same sum to the last bit";
  Vec3 force, torque;
  double largest = 0;
  for (std::size_t v = 0; v < f.size(); ++v) {
    force += f[v];
    torque += cross(mesh.x[v], f[v]);
    largest = std::max(largest, norm(f[v]));
  }
  EXPECT_GT(largest, 0);
  EXPECT_LT(norm(force), 1e-13 * 642 * largest) << "642 vertices of 20 terms";
  EXPECT_LT(norm(torque), 1e-13 * 642 * 8 * largest) << "lever arms of up to 8";
  add_all(again);
  for (std::size_t v = 0; v < f.size(); ++v)
    EXPECT_LT(norm(again[v] - 2 * f[v]), round_off * (largest + norm(f[v])));
}

}  // namespace
