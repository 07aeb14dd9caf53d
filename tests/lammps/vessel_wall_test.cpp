// fix hemo/wall through LAMMPS: its forces are minus the gradient of its own energy, and towards
// the axis of a tube.
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <mpi.h>

#include "atom.h"
#include "lammps.h"
#include "modify.h"

#include "contact/wall.hpp"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_wall.h"
#include "lammps/host.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;

constexpr double gradient_tolerance = 1e-7;
const Vec3 axis_point{10, 0, 10};
constexpr double radius = 8;

/// One atom in a tube along y.
class AtomInATube {
public:
  AtomInATube() : host_({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD) {
    for (const char* line :
         {"units lj", "atom_style molecular", "newton on", "boundary p p p",
          "region b block 0 20 0 12 0 20", "create_box 1 b", "create_atoms 1 single 10 6 10",
          "mass * 1", "neighbor 1.0 bin", "pair_style zero 1", "pair_coeff * *",
          "fix wall all hemo/wall 0.02 1.0 1.122462048309373",
          "fix fluid all hemo/fluid tau 1 tube y 10 10 8", "timestep 1.0"})
      host_.command(line);
  }

  struct Result {
    Vec3 force;
    double energy;
  };
  Result at(const Vec3& x) {
    char line[160];
    std::snprintf(line, sizeof line, "set atom 1 x %.17g y %.17g z %.17g", x.x, x.y, x.z);
    host_.command(line);
    host_.command("run 0 post no");
    auto& atom = *host_.lammps().atom;
    std::array<double, 3> mine{}, all{};
    for (int i = 0; i < atom.nlocal; ++i)
      for (std::size_t d = 0; d < 3; ++d) mine[d] += atom.f[i][d];
    MPI_Allreduce(mine.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    auto* wall = lammps::find_fix<LAMMPS_NS::FixHemoWall>(&host_.lammps(), "hemo/wall");
    return {{all[0], all[1], all[2]}, wall->compute_scalar()};
  }

private:
  lammps::Host host_;
};

TEST(FixHemoWall, ForceIsMinusTheGradientOfItsEnergy) {
  AtomInATube tube;
  test::Random random(3);
  for (int k = 0; k < 12; ++k) {
    // Inside one cell of the distance's grid, away from its faces, where the gradient jumps.
    const double phi = random.uniform(0, 2 * std::numbers::pi), r = random.uniform(7.0, 7.3);
    Vec3 x = axis_point + r * Vec3{std::cos(phi), 0, std::sin(phi)};
    for (std::size_t d = 0; d < 3; ++d)
      x[d] = std::floor(x[d] - 0.5) + 0.5 +
             std::min(0.95, std::max(0.05, x[d] - 0.5 - std::floor(x[d] - 0.5)));
    const auto here = tube.at(x);
    Vec3 slope;
    for (std::size_t d = 0; d < 3; ++d)
      slope[d] = test::slope_at_zero(0.02, [&](double h) {
        Vec3 y = x;
        y[d] += h;
        return tube.at(y).energy;
      });
    EXPECT_LT(norm(here.force + slope), gradient_tolerance * (norm(here.force) + 0.02));
  }
}

TEST(FixHemoWall, FollowsTheTubesDistanceAndEndsAtItsCut) {
  AtomInATube tube;
  const contact::WallRepulsion wall{0.02, 1.0, 1.122462048309373};
  for (const double phi : {0.1, 0.9, 2.0, 4.4}) {
    const Vec3 out{std::cos(phi), 0, std::sin(phi)};
    // The distance is interpolated between nodes: off by h^2/(8 r) on a circle of radius r. Twice
    // that, since the gradient's size is off too.
    const double off = 2 * 1.0 / (8 * 7.0);
    const double d = 0.95;
    const auto at = tube.at(axis_point + (radius - d) * out);
    const double push = -dot(at.force, out);
    EXPECT_LE(push, contact::force(wall, d - off));
    EXPECT_GE(push, contact::force(wall, d + off));
    EXPECT_LT(std::fabs(at.force.y), 1e-12);
    EXPECT_EQ(norm(tube.at(axis_point + (radius - 1.2) * out).force), 0);
    EXPECT_EQ(tube.at(axis_point).energy, 0);
  }
}

}  // namespace
