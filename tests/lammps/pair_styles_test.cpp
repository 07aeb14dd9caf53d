// Pair forces through LAMMPS's neighbour lists and ranks equal the direct sum over all pairs; contacts settle.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "atom.h"
#include "lammps.h"

#include "contact/lennard_jones.hpp"
#include "contact/morse.hpp"
#include "lammps/host.hpp"
#include "magnetic/dipole.hpp"
#include "magnetic/moment.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;

constexpr double box = 16;

/// Positions (0-2) and forces (3-5) of all atoms by tag - 1.
std::vector<std::array<double, 6>> gather(lammps::Host& host) {
  auto* atom = host.lammps().atom;
  std::vector<std::array<double, 6>> mine(static_cast<std::size_t>(atom->natoms)), all(mine.size());
  for (int i = 0; i < atom->nlocal; ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      mine[static_cast<std::size_t>(atom->tag[i] - 1)][d] = atom->x[i][d];
      mine[static_cast<std::size_t>(atom->tag[i] - 1)][d + 3] = atom->f[i][d];
    }
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(6 * mine.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

Vec3 nearest(Vec3 d) {
  for (std::size_t a = 0; a < 3; ++a) d[a] -= box * std::round(d[a] / box);
  return d;
}

TEST(PairStyles, EqualTheDirectSumAcrossBordersWithIntraMolecularExclusion) {
  // Types 1: vertices of four molecules; 2: carriers. A hybrid, as in every case.
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD);
  for (const char* line : {"units lj", "atom_style molecular", "newton on", "special_bonds lj/coul 1 1 1", "region b block 0 16 0 16 0 16",
                           "create_box 2 b", "mass * 1", "neighbor 1.0 bin"})
    host.command(line);
  test::Random random(31);
  constexpr int vertices = 160, carriers = 60;
  std::vector<Vec3> x;
  while (x.size() < vertices + carriers) {
    const Vec3 p{random.uniform(0, box), random.uniform(0, box), random.uniform(0, box)};
    bool clear = true;
    for (const Vec3& q : x) clear = clear && norm(nearest(p - q)) > 0.55;
    if (!clear) continue;
    char line[128];
    std::snprintf(line, sizeof line, "create_atoms %d single %.17g %.17g %.17g", x.size() < vertices ? 1 : 2, p.x, p.y, p.z);
    host.command(line);
    x.push_back(p);
  }
  for (int k = 0; k < vertices; ++k) host.command("set atom " + std::to_string(k + 1) + " mol " + std::to_string(k % 4 + 1));
  for (const char* line :
       {"group cells type 1", "group carriers type 2", "neigh_modify every 1 delay 0 check yes", "neigh_modify exclude molecule/intra cells",
        "pair_style hybrid hemo/contact hemo/dipole 3.0", "pair_coeff 1 1 hemo/contact morse 0.2 1.5 1.0 2.5 lj 0.1 0.8",
        "pair_coeff 1 2 hemo/contact lj 0.1 1.0", "pair_coeff 2 2 hemo/dipole 0.5 soft 30",
        "fix field carriers hemo/field susceptibility 2 0.5 uniform 0.3 -0.2 0.9", "run 0"})
    host.command(line);
  const auto state = gather(host);

  const contact::Morse morse{0.2, 1.5, 1.0, 2.5};
  const contact::LennardJones cells{0.1, 0.8}, mixed{0.1, 1.0};
  const Vec3 m = magnetic::linear_moment(0.5, {0.3, -0.2, 0.9});
  std::vector<Vec3> f(x.size());
  for (int i = 0; i < vertices + carriers; ++i)
    for (int j = 0; j < i; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const Vec3 d = nearest(x[a] - x[b]);
      const double r2 = norm2(d), r = std::sqrt(r2);
      Vec3 on_i;
      const auto lj = [&](const contact::LennardJones& law) {
        if (r < contact::lj_cutoff_over_sigma * law.sigma) on_i += contact::force_over_r(law, r2) * d;
      };
      if (i < vertices) {
        if (i % 4 == j % 4) continue;
        lj(cells);
        if (r < morse.cutoff) on_i += (contact::force(morse, r) / r) * d;
      } else if (j < vertices) {
        lj(mixed);
      } else if (r < 3.0) {
        on_i += magnetic::dipole_dipole(m, m, d).on_j;
        on_i += magnetic::soft_repulsion(magnetic::contact_pull(norm(m), norm(m), 0.5), 30, 0.5, d).on_j;
      }
      f[a] += on_i;
      f[b] -= on_i;
    }
  double largest = 0, worst = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    largest = std::max(largest, norm(f[k]));
    worst = std::max(worst, norm(f[k] - Vec3{state[k][3], state[k][4], state[k][5]}));
  }
  EXPECT_GT(largest, 0.1);
  EXPECT_LT(worst, 1e-12 * largest);
}

TEST(PairStyles, AContactSettlesAtItsDistanceInTheFieldOfTheDemo) {
  // Two carriers along a uniform field, 0.1 T in the demo's units: pull and push balance where r = d. Across a border.
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD);
  for (const char* line :
       {"units lj", "atom_style molecular", "newton on", "region b block 0 16 0 16 0 16", "create_box 1 b", "mass * 1", "neighbor 1.0 bin",
        "create_atoms 1 single 8 8 15.6", "create_atoms 1 single 8.05 8 0.4", "neigh_modify every 1 delay 0 check yes",
        "pair_style hemo/dipole 3.0", "pair_coeff * * 0.5 soft 30", "fix drag all hemo/drag radius 1 0.25",
        "fix field all hemo/field susceptibility 1 0.0157079633 uniform 0 0 2.7442", "fix fluid all hemo/fluid tau 1", "timestep 1.0",
        "run 3000"})
    host.command(line);
  const auto state = gather(host);
  const Vec3 d = nearest(Vec3{state[0][0], state[0][1], state[0][2]} - Vec3{state[1][0], state[1][1], state[1][2]});
  std::printf("distance of two touching carriers %.5f, expected 0.5, tolerance 0.002\n", norm(d));
  EXPECT_NEAR(norm(d), 0.5, 0.002);
  EXPECT_NEAR(std::fabs(d.z) / norm(d), 1, 1e-3) << "they point along the field";
  const double centre = std::fmod((state[0][2] + (state[1][2] < 8 ? state[1][2] + box : state[1][2])) / 2, box);
  EXPECT_NEAR(std::min(centre, box - centre), 0, 0.01) << "their centre stays: no net force";
}

}  // namespace
