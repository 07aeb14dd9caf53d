// compute hemo/cell through LAMMPS: a known ellipsoid across rank and periodic borders.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mpi.h>
#include <unistd.h>

#include "atom.h"
#include "domain.h"
#include "lammps.h"
#include "modify.h"

#include "analysis/cell_shape.hpp"
#include "lammps/compute_hemo_cell.h"
#include "lammps/host.hpp"
#include "support/shapes.hpp"

namespace {

using namespace hemomag;
using Column = LAMMPS_NS::ComputeHemoCell::Column;
using Rows = std::vector<std::array<double, Column::columns>>;

constexpr double degree = std::numbers::pi / 180;
constexpr double box[3] = {12, 14, 13};
/// What the issue asks of other rank counts; sums of 640 terms in another order give 1e-14.
constexpr double other_order = 1e-10;

Vec3 turned_x(const Vec3& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
}

/// The ellipsoid of semi-axes 2.5, 4, 1.2 along x, y, z.
test::Surface ellipsoid() {
  test::Surface s = test::icosphere(1, 3);
  for (Vec3& x : s.points) x = {2.5 * x.x, 4 * x.y, 1.2 * x.z};
  return s;
}

/// One cell per surface, in LAMMPS, moved by hand.
class Cells {
public:
  Cells(MPI_Comm comm, const std::vector<test::Surface>& surfaces)
      : comm_(comm), host_({"-screen", "none", "-log", "none"}, comm) {
    MPI_Comm_rank(comm, &rank_);
    int id = static_cast<int>(getpid());
    MPI_Bcast(&id, 1, MPI_INT, 0, comm);
    directory_ = std::filesystem::temp_directory_path() / ("hemomag_cell_" + std::to_string(id));
    if (rank_ == 0) {
      std::filesystem::create_directories(directory_);
      write(surfaces, directory_ / "cells.data");
    }
    MPI_Barrier(comm);
    for (const std::string& line :
         {std::string("units lj"), std::string("atom_style molecular"), std::string("newton on"),
          std::string("boundary p p p"), std::string("special_bonds lj/coul 1 1 1"),
          std::string("neighbor 0.4 bin"), std::string("comm_modify cutoff 2.0"),
          std::string("angle_style hemo/membrane"),
          "read_data " + (directory_ / "cells.data").string(),
          std::string("angle_coeff 1 0 1 0 100 0 50 0 1"), std::string("mass * 1"),
          std::string("pair_style zero 1"), std::string("pair_coeff * *"),
          std::string("compute cells all hemo/cell"), std::string("timestep 1")})
      host_.command(line);
  }
  ~Cells() {
    MPI_Barrier(comm_);
    if (rank_ == 0) std::filesystem::remove_all(directory_);
  }
  Cells(const Cells&) = delete;
  Cells& operator=(const Cells&) = delete;

  /// Put every vertex at x(k), unwrapped, and its velocity to v(k); k counts from 0.
  void move(const std::function<Vec3(std::size_t)>& x, const std::function<Vec3(std::size_t)>& v) {
    auto& atom = *host_.lammps().atom;
    for (int i = 0; i < atom.nlocal; ++i) {
      const auto k = static_cast<std::size_t>(atom.tag[i] - 1);
      const Vec3 at = x(k), velocity = v(k);
      atom.image[i] = ((LAMMPS_NS::imageint)LAMMPS_NS::imageint(IMGMAX) << IMG2BITS) |
                      ((LAMMPS_NS::imageint)IMGMAX << IMGBITS) | IMGMAX;
      for (int d = 0; d < 3; ++d) {
        atom.x[i][d] = at[static_cast<std::size_t>(d)];
        atom.v[i][d] = velocity[static_cast<std::size_t>(d)];
      }
      host_.lammps().domain->remap(atom.x[i], atom.image[i]);
    }
  }

  Rows rows() {
    host_.command("run 0 post no");
    auto* compute = host_.lammps().modify->compute[host_.lammps().modify->find_compute("cells")];
    compute->compute_array();
    Rows all(static_cast<std::size_t>(compute->size_array_rows));
    for (std::size_t r = 0; r < all.size(); ++r)
      std::copy_n(compute->array[r], static_cast<int>(Column::columns), all[r].begin());
    return all;
  }

  lammps::Host& host() { return host_; }

private:
  static void write(const std::vector<test::Surface>& surfaces, const std::string& path) {
    std::ofstream out(path);
    out.precision(17);
    std::size_t points = 0, triangles = 0;
    for (const auto& s : surfaces) points += s.points.size(), triangles += s.triangles.size();
    out << "cells\n\n"
        << points << " atoms\n"
        << triangles << " angles\n1 atom types\n"
        << "1 angle types\n0 " << box[0] << " xlo xhi\n0 " << box[1] << " ylo yhi\n0 " << box[2]
        << " zlo zhi\n\nAtoms\n\n";
    std::size_t tag = 0;
    for (std::size_t m = 0; m < surfaces.size(); ++m)
      for (const Vec3& x : surfaces[m].points) {
        out << ++tag << " " << m + 1 << " 1";
        double in_box[3];
        int image[3];
        for (std::size_t d = 0; d < 3; ++d) {
          image[d] = static_cast<int>(std::floor(x[d] / box[d]));
          out << " " << (in_box[d] = x[d] - image[d] * box[d]);
        }
        out << " " << image[0] << " " << image[1] << " " << image[2] << "\n";
      }
    out << "\nAngles\n\n";
    std::size_t angle = 0, first = 1;
    for (const auto& s : surfaces) {
      for (const auto& [i, j, k] : s.triangles)
        out << ++angle << " 1 " << first + std::size_t(i) << " " << first + std::size_t(j) << " "
            << first + std::size_t(k) << "\n";
      first += s.points.size();
    }
  }

  MPI_Comm comm_;
  int rank_ = 0;
  std::filesystem::path directory_;
  lammps::Host host_;
};

const auto at_rest = [](std::size_t) { return Vec3{}; };

/// The ellipsoid turned in the shear plane and moved.
Vec3 placed(const Vec3& x, double angle, const Vec3& centre) { return turned_x(x, angle) + centre; }

TEST(ComputeCell, IsTheSameWhereverTheCellLies) {
  const auto shape = ellipsoid();
  analysis::SolidMoments moments;
  for (const auto& [i, j, k] : shape.triangles)
    moments.add(shape.points[std::size_t(i)], shape.points[std::size_t(j)],
                shape.points[std::size_t(k)]);
  const auto expected = analysis::cell_shape(moments);
  double highest_y = 0;
  for (const Vec3& x : shape.points) highest_y = std::max(highest_y, x.y);
  for (const Vec3& centre :
       {Vec3{6, 7, 6.5}, Vec3{0, 0, 0}, Vec3{11.9, 0.3, 13.2}, Vec3{-30.1, 7 + 14 * 40, 6.5}}) {
    auto surface = shape;
    for (Vec3& x : surface.points) x += centre;
    Cells cells(MPI_COMM_WORLD, {surface});
    cells.move([&](std::size_t k) { return surface.points[k]; },
               [](std::size_t) {
                 return Vec3{0.1, -0.2, 0.3};
               });
    const auto row = cells.rows()[0];
    EXPECT_EQ(row[Column::molecule], 1);
    EXPECT_NEAR(row[Column::volume], expected.volume, other_order * expected.volume);
    EXPECT_NEAR(row[Column::area], expected.area, other_order * expected.area);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_NEAR(row[Column::centre + d], centre[d], other_order * 560);
      EXPECT_NEAR(row[Column::velocity + d], (Vec3{0.1, -0.2, 0.3})[d], other_order);
      EXPECT_NEAR(row[Column::semi_axes + d], expected.semi_axes[d], other_order * 4);
    }
    EXPECT_NEAR(std::fabs(row[Column::long_axis + 1]), 1, other_order);
    EXPECT_NEAR(std::fabs(row[Column::short_axis + 2]), 1, other_order);
    EXPECT_NEAR(row[Column::taylor], (4 - 1.2) / (4 + 1.2), other_order);
    EXPECT_NEAR(row[Column::taylor_in_plane], (4 - 1.2) / (4 + 1.2), other_order);
    EXPECT_NEAR(row[Column::inclination], 0, 1e-8);
    EXPECT_NEAR(row[Column::extent + 1], 2 * highest_y, other_order * 8);
  }
}

TEST(ComputeCell, ARigidRotationIsThePhaseOverSeveralTurnsWithoutTreading) {
  const auto shape = ellipsoid();
  Cells cells(MPI_COMM_WORLD, {shape});
  double first_phase = 0, first_treading = 0;
  for (int step = 0; step <= 40; ++step) {
    const double angle = -37.0 * step;  // four turns and more, in the sense of a shear flow
    const Vec3 centre{0.3 * step, 2.0 * step, -0.2};  // through the borders meanwhile
    cells.move(
        [&](std::size_t k) { return placed(shape.points[k], (10 + angle) * degree, centre); },
        at_rest);
    const auto row = cells.rows()[0];
    if (step == 0) first_phase = row[Column::phase], first_treading = row[Column::treading];
    EXPECT_NEAR(row[Column::phase] - first_phase, angle, 1e-8) << "step " << step;
    EXPECT_NEAR(row[Column::treading], first_treading, 1e-8) << "step " << step;
    EXPECT_NEAR(std::remainder(row[Column::inclination] - 10 - angle, 180), 0, 1e-8);
    EXPECT_NEAR(row[Column::centre + 1], centre.y, 1e-9) << "step " << step;
  }
}

TEST(ComputeCell, TheCentreIsFollowedPastTheRangeOfImageFlags) {
  const auto shape = ellipsoid();
  Cells cells(MPI_COMM_WORLD, {shape});
  for (int step = 0; step <= 6; ++step) {
    const Vec3 centre{3, box[1] * 400 * step + 1, -box[2] * 170 * step};  // flags hold +-512
    cells.move([&](std::size_t k) { return shape.points[k] + centre; }, at_rest);
    const auto row = cells.rows()[0];
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_NEAR(row[Column::centre + d], centre[d], 1e-14 * box[1] * 2400 * 10)
          << "step " << step;
  }
}

TEST(ComputeCell, ATreadingMembraneOnAFixedEllipsoidTurnsInItsBodyFrame) {
  // Keller and Skalak's motion: material points circle on the ellipsoid, x -> D R(t) D^-1 x with D
  // the stretch, while the shape stands still. A whole turn of R is a whole turn of the marker.
  const Vec3 axes{2.5, 4, 1.2};
  const auto sphere = test::icosphere(1, 3);
  const Vec3 centre{0.2, 13.5, 6};
  Cells cells(MPI_COMM_WORLD, {ellipsoid()});
  const double tilt = 20 * degree;
  double first = 0, inclination = 0;
  for (int step = 0; step <= 48; ++step) {
    const double angle = -7.5 * step;  // one turn in all
    cells.move(
        [&](std::size_t k) {
          const Vec3 x = turned_x(sphere.points[k], angle * degree);
          return placed({axes.x * x.x, axes.y * x.y, axes.z * x.z}, tilt, centre);
        },
        at_rest);
    const auto row = cells.rows()[0];
    if (step == 0) first = row[Column::treading], inclination = row[Column::inclination];
    EXPECT_NEAR(inclination, 20, 1e-8);
    EXPECT_NEAR(row[Column::inclination], inclination, 1e-6) << "isotropic moments of the sphere";
    // The marker lies on the outline at an eccentric angle that falls by the rotation of R.
    const double body = row[Column::treading] * degree;
    const double eccentric = std::atan2(std::sin(body) / axes.z, std::cos(body) / axes.y) / degree;
    const double start =
        std::atan2(std::sin(first * degree) / axes.z, std::cos(first * degree) / axes.y) / degree;
    EXPECT_NEAR(std::remainder(eccentric - start - angle, 360), 0, 1e-6) << "step " << step;
    if (step == 48) {
      EXPECT_NEAR(row[Column::treading] - first, -360, 1e-6);
    }
  }
}

TEST(ComputeCell, IsTheSameOnOneTwoAndFourRanks) {
  int rank = 0, ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  // Three cells, one across the corner of the box, one across the borders of ranks, one small.
  std::vector<test::Surface> surfaces{ellipsoid(), ellipsoid(), test::spiky(1, 2)};
  for (Vec3& x : surfaces[0].points) x = placed(x, 0.4, {0.1, 0.2, -0.3});
  for (Vec3& x : surfaces[1].points) x = placed(x, -1.1, {6.1, 7.2, 6.4});
  for (Vec3& x : surfaces[2].points) x += Vec3{6, 0.1, 6.5};
  std::vector<Rows> results;
  for (int n = 1; n <= ranks; n *= 2) {
    MPI_Comm some = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank < n ? 0 : MPI_UNDEFINED, rank, &some);
    if (some != MPI_COMM_NULL) {
      {
        Cells cells(some, surfaces);
        results.push_back(cells.rows());
      }
      MPI_Comm_free(&some);
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  if (rank != 0) return;
  for (std::size_t n = 1; n < results.size(); ++n) {
    ASSERT_EQ(results[n].size(), 3u);
    double worst = 0;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < Column::columns; ++c)
        worst = std::max(worst, std::fabs(results[n][r][c] - results[0][r][c]) /
                                    std::max(1.0, std::fabs(results[0][r][c])));
    std::printf("%d ranks against 1: largest relative difference %.2e, tolerance %.0e\n", 1 << n,
                worst, other_order);
    EXPECT_LT(worst, other_order);
  }
}

TEST(ComputeCell, TheFixWritesARowACellInItsUnits) {
  auto surface = ellipsoid();
  for (Vec3& x : surface.points) x += Vec3{0.5, 13.8, 6};
  const std::string path =
      (std::filesystem::temp_directory_path() / "hemomag_compute_cell_test.csv").string();
  Cells cells(MPI_COMM_WORLD, {surface, test::icosphere(1, 2)});
  cells.host().command("fix cells all hemo/cells 20 cells " + path +
                       " dx_um 0.5 dt_s 1e-6 follow 10");
  // A thermo variable reads the same array.
  cells.host().command("variable volume equal c_cells[1][2]");
  cells.host().command("thermo_style custom step v_volume");
  cells.host().command("run 40");
  const auto row = cells.rows()[0];
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) return;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(std::count(line.begin(), line.end(), ','), static_cast<int>(Column::columns));
  EXPECT_EQ(line.substr(0, 32), "time_s,cell,volume_um3,area_um2,");
  std::vector<std::vector<double>> table;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string word;
    table.emplace_back();
    while (std::getline(words, word, ',')) table.back().push_back(std::stod(word));
  }
  ASSERT_EQ(table.size(), 6u) << "steps 0, 20 and 40, two cells";
  const auto& last = table[4];
  constexpr double digits = 1e-8;  // nine are written
  EXPECT_NEAR(last[0], 40e-6, 40e-6 * digits);
  EXPECT_EQ(last[1], 1);
  EXPECT_NEAR(last[1 + Column::volume], row[Column::volume] / 8, digits * 10);
  EXPECT_NEAR(last[1 + Column::area], row[Column::area] / 4, digits * 20);
  EXPECT_NEAR(last[1 + Column::centre + 1], 6.9, digits * 7);
  EXPECT_NEAR(last[1 + Column::semi_axes], row[Column::semi_axes] / 2, digits * 2);
  std::filesystem::remove(path);
}

}  // namespace
