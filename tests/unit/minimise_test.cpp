// The minimiser finds minima that are known.
#include <gtest/gtest.h>

#include <limits>

#include "base/minimise.hpp"

namespace {

using namespace hemomag;

constexpr double found_to = 1e-7;  // largest_force over the least curvature of each energy

TEST(Minimise, FindsTheBottomOfANarrowValley) {
  // Rosenbrock's function of each point's x and y; the minimum is (1, 1).
  const auto energy = [](const std::vector<Vec3>& x, std::vector<Vec3>& f) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double a = 1 - x[i].x, b = x[i].y - x[i].x * x[i].x;
      sum += a * a + 100 * b * b + x[i].z * x[i].z;
      f[i] = {2 * a + 400 * b * x[i].x, -200 * b, -2 * x[i].z};
    }
    return sum;
  };
  std::vector<Vec3> x{{-1.2, 1, 3}, {2, -1, -1}};
  MinimiseOptions how;
  how.largest_force = 1e-9;
  const Minimum m = minimise(x, energy, how);
  EXPECT_LE(m.largest_force, how.largest_force);
  for (const Vec3& p : x) EXPECT_LT(norm(p - Vec3{1, 1, 0}), found_to);
}

TEST(Minimise, StaysWhereTheEnergyIsFinite) {
  // -ln(1 - x) - 3 x/2: infinite from x = 1 on, least where 1/(1 - x) = 3/2.
  const auto energy = [](const std::vector<Vec3>& x, std::vector<Vec3>& f) {
    if (x[0].x >= 1) return std::numeric_limits<double>::infinity();
    f[0] = {1.5 - 1 / (1 - x[0].x), 0, 0};
    return -std::log(1 - x[0].x) - 1.5 * x[0].x;
  };
  std::vector<Vec3> x{{-5, 0, 0}};
  MinimiseOptions how;
  how.largest_force = 1e-9;
  how.largest_move = 100;
  how.first_scale = 100;
  const Minimum m = minimise(x, energy, how);
  EXPECT_LE(m.largest_force, how.largest_force);
  EXPECT_NEAR(x[0].x, 1.0 / 3, found_to);
}

}  // namespace
