// A whole cell's energy: forces are minus its gradient, and its minimum is the rest mesh.
#include <gtest/gtest.h>

#include "base/minimise.hpp"
#include "membrane/mesh.hpp"
#include "membrane/whole_cell.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;
using test::Random;

constexpr double gradient_tolerance =
    1e-7;                            // relative to the largest force; differences are good to 1e-9
constexpr double round_off = 1e-12;  // sums of some hundred forces of the largest one's size

membrane::WholeCell cell(const membrane::TriangleMesh& mesh) {
  return {mesh, {.mu0 = 6.3, .k_a = 4.72, .k_d = 231, .k_v = 249, .k_b = 0.5}};
}

std::vector<Vec3> disturbed(const std::vector<Vec3>& x, double by, Random& random) {
  std::vector<Vec3> y = x;
  for (Vec3& p : y)
    p += by * Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  return y;
}

double largest(const std::vector<Vec3>& f) {
  double most = 0;
  for (const Vec3& v : f) most = std::max(most, norm(v));
  return most;
}

TEST(WholeCell, RestsOnItsMesh) {
  const auto mesh = membrane::red_cell_mesh(200, 7.82, 1);
  std::vector<Vec3> f(mesh.x.size());
  cell(mesh).energy(mesh.x, f);
  EXPECT_LT(largest(f), 1e-10);  // pN, where a stretched cell has some 10
}

TEST(WholeCell, ForcesAreMinusTheGradientAndPushNothingAsAWhole) {
  const auto mesh = membrane::red_cell_mesh(200, 7.82, 1);
  const auto network = cell(mesh);
  Random random(2);
  const auto x = disturbed(mesh.x, 0.05, random);
  std::vector<Vec3> f(x.size()), unused(x.size());
  network.energy(x, f);
  Vec3 force, torque;
  for (std::size_t i = 0; i < x.size(); ++i) force += f[i], torque += cross(x[i], f[i]);
  EXPECT_LT(norm(force), round_off * largest(f) * 200);
  EXPECT_LT(norm(torque), round_off * largest(f) * 200);
  const double edge = 0.9;  // um
  const double error = test::gradient_error(
      x, f, edge, [&](const std::vector<Vec3>& at) { return network.energy(at, unused); });
  EXPECT_LT(error, gradient_tolerance);
}

TEST(WholeCell, ADisturbedCellFallsBackToItsMesh) {
  const auto mesh = membrane::red_cell_mesh(200, 7.82, 1);
  const auto network = cell(mesh);
  Random random(3);
  auto x = disturbed(mesh.x, 0.05, random);
  std::vector<Vec3> f(x.size());
  const double rest = network.energy(mesh.x, f);
  MinimiseOptions how;
  how.largest_force = 1e-6;  // pN
  const auto found = minimise(
      x, [&](const auto& at, auto& force) { return network.energy(at, force); }, how);
  EXPECT_LE(found.largest_force, how.largest_force);
  EXPECT_NEAR(found.energy, rest, 1e-9 * std::fabs(rest));
  EXPECT_NEAR(network.area(x), network.rest_area(), 1e-6 * network.rest_area());
  EXPECT_NEAR(network.volume(x), network.rest_volume(), 1e-6 * network.rest_volume());
}

}  // namespace
