// The starting state: how many, how far apart, and carriers outside cells.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "analysis/inside.hpp"
#include "base/error.hpp"
#include "case/case_file.hpp"
#include "case/placement.hpp"
#include "case/vessel.hpp"

namespace {

using namespace hemomag;

Vec3 nearest(Vec3 d, const case_::Case& c) {
  for (std::size_t a = 0; a < 2; ++a)
    d[a] -= c.channel.size[a] * std::round(d[a] / c.channel.size[a]);
  return d;
}

TEST(Placement, TheDemoHasFourteenCellsApartAndCarriersOutside) {
  const auto c = case_::read_case(HEMOMAG_SOURCE_DIR "/examples/margination_demo.toml", {});
  for (const std::uint64_t seed : {1, 2, 3}) {
    auto seeded = c;
    seeded.seed = seed;
    const auto system = case_::place(seeded);
    ASSERT_EQ(system.cells.size(), 14u);
    ASSERT_EQ(system.carriers.size(), 60u);
    double closest = 1, plate = 1, carrier = 1;
    for (std::size_t a = 0; a < 14; ++a)
      for (const Vec3& x : system.cells[a].x) {
        plate = std::min({plate, x.z, c.channel.size[2] - x.z});
        for (std::size_t b = 0; b < a; ++b)
          for (const Vec3& y : system.cells[b].x)
            closest = std::min(closest, norm(nearest(x - y, c)));
        for (const auto& p : system.carriers)
          carrier = std::min(carrier, norm(nearest(x - p.beads[0], c)));
      }
    EXPECT_GE(closest, 0.40e-6);
    EXPECT_GE(plate, 0.3e-6);
    EXPECT_GE(carrier, 0.56e-6);

    std::vector<analysis::SurfaceTriangle> triangles;
    for (std::size_t a = 0; a < 14; ++a)
      for (const auto& t : system.models[0].mesh.triangles) {
        analysis::SurfaceTriangle s;
        for (std::size_t k = 0; k < 3; ++k) {
          s.x[k] = system.cells[a].x[static_cast<std::size_t>(t[k])];
          s.tag[k] = static_cast<std::int64_t>(642 * a) + t[k];
        }
        triangles.push_back(s);
      }
    std::vector<Vec3> points;
    for (const auto& p : system.carriers) points.push_back(p.beads[0]);
    for (std::size_t a = 0; a < 14; ++a) {  // between the dimples: inside by construction
      Vec3 centre;
      for (const Vec3& x : system.cells[a].x) centre += x / 642;
      points.push_back(centre);
    }
    const analysis::ChannelBox box{{c.channel.size[0], c.channel.size[1], c.channel.size[2]},
                                   false};
    // Points may lie outside the box by a period, as unwrapped cells do.
    for (Vec3& p : points)
      for (std::size_t d = 0; d < 2; ++d)
        p[d] -= c.channel.size[d] * std::floor(p[d] / c.channel.size[d]);
    const auto times = analysis::enclosure(points, triangles, box);
    for (std::size_t k = 0; k < 60; ++k) EXPECT_EQ(times[k], 0) << "carrier " << k;
    for (std::size_t k = 60; k < times.size(); ++k)
      EXPECT_EQ(times[k], 1) << "centre of cell " << k - 60;
  }
}

TEST(Placement, TheSameSeedGivesTheSameState) {
  auto c = case_::read_case(HEMOMAG_SOURCE_DIR "/examples/margination_demo.toml",
                            {"cell.hematocrit=0.05"});
  const auto a = case_::place(c), b = case_::place(c);
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t k = 0; k < a.cells.size(); ++k) EXPECT_EQ(a.cells[k].x, b.cells[k].x);
  c.seed = 9;
  EXPECT_NE(case_::place(c).carriers[0].beads[0], a.carriers[0].beads[0]);
}

TEST(Placement, WormsAreStraightChainsOutsideCells) {
  auto c = case_::read_case(HEMOMAG_SOURCE_DIR "/examples/margination_demo.toml",
                            {"cell.hematocrit=0.1", "carrier.kind=\"worm\"", "carrier.beads=12",
                             "carrier.count=5", "carrier.stretching=100 uN/m"});
  const auto system = case_::place(c);
  ASSERT_EQ(system.carriers.size(), 5u);
  for (const auto& worm : system.carriers) {
    ASSERT_EQ(worm.beads.size(), 12u);
    for (std::size_t k = 1; k < 12; ++k)
      EXPECT_NEAR(norm(worm.beads[k] - worm.beads[k - 1]), 250e-9, 1e-15);
    for (const Vec3& p : worm.beads)
      for (const auto& cell : system.cells)
        for (const Vec3& x : cell.x) EXPECT_GE(norm(nearest(x - p, c)), 0.56e-6);
  }
}

/// An ellipsoid off its file's origin, in units of 2 um, as a user's own surface.
std::string write_surface(const membrane::TriangleMesh& mesh) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("hemomag_cell_" + std::to_string(getpid()) + ".off");
  std::ofstream file(path);
  file.precision(17);
  file << "OFF\n" << mesh.x.size() << " " << mesh.triangles.size() << " 0\n";
  for (const Vec3& p : mesh.x) file << p.x + 7 << " " << p.y - 3 << " " << p.z << "\n";
  for (const auto& t : mesh.triangles) file << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  return path.string();
}

TEST(Placement, CellsOfEveryKindKeepApartAndCarriersOutside) {
  auto c = case_::read_case(HEMOMAG_SOURCE_DIR "/examples/margination_demo.toml", {});
  const auto path = write_surface(membrane::evened_mesh(membrane::spheroid(2, 1.2), 200, 1));
  auto& red = c.cells[0];
  red.hematocrit.reset(), red.count = 3;
  auto platelet = case_::standard_cell(case_::CellKind::platelet);
  platelet.count = 12;
  auto white = case_::standard_cell(case_::CellKind::white);
  white.count = 1, white.vertices = 1442;
  auto own = case_::standard_cell(case_::CellKind::rbc);
  own.hematocrit.reset(), own.count = 4;
  own.mesh = path, own.mesh_unit = 2e-6, own.surface = case_::read_cell_surface(path);
  own.vertices = 200;
  c.cells = {red, platelet, white, own};
  std::filesystem::remove(path);
  const auto system = case_::place(c);
  ASSERT_EQ(system.cells.size(), 20u);
  double closest = 1, plate = 1, carrier = 1;
  std::vector<analysis::SurfaceTriangle> triangles;
  std::vector<Vec3> points;
  std::int64_t first = 0;
  for (std::size_t a = 0; a < system.cells.size(); ++a) {
    const auto& cell = system.cells[a];
    const auto& model = system.models[cell.model];
    ASSERT_EQ(cell.x.size(), model.mesh.x.size());
    EXPECT_EQ(static_cast<int>(cell.x.size()), c.cells[cell.model].vertices);
    for (const Vec3& x : cell.x) {
      plate = std::min({plate, x.z, c.channel.size[2] - x.z});
      for (std::size_t b = 0; b < a; ++b)
        for (const Vec3& y : system.cells[b].x)
          closest = std::min(closest, norm(nearest(x - y, c)));
      for (const auto& p : system.carriers)
        carrier = std::min(carrier, norm(nearest(x - p.beads[0], c)));
    }
    for (const auto& t : model.mesh.triangles) {
      analysis::SurfaceTriangle s;
      for (std::size_t k = 0; k < 3; ++k) {
        s.x[k] = cell.x[static_cast<std::size_t>(t[k])];
        s.tag[k] = first + t[k];
      }
      triangles.push_back(s);
    }
    first += static_cast<std::int64_t>(cell.x.size());
  }
  EXPECT_GE(closest, 0.40e-6);
  EXPECT_GE(plate, 0.3e-6);
  EXPECT_GE(carrier, 0.56e-6);
  // Every carrier is outside every cell, and one vertex of a cell is inside none of the others (its
  // own passes through it, so it is moved out along the normal, from the centre).
  for (const auto& p : system.carriers) points.push_back(p.beads[0]);
  for (const auto& cell : system.cells) {
    Vec3 centre;
    for (const Vec3& x : cell.x) centre += x / static_cast<double>(cell.x.size());
    Vec3 farthest = centre;
    for (const Vec3& x : cell.x)
      if (norm(x - centre) > norm(farthest - centre)) farthest = x;
    points.push_back(farthest + (0.05e-6 / norm(farthest - centre)) * (farthest - centre));
  }
  for (Vec3& p : points)
    for (std::size_t d = 0; d < 2; ++d)
      p[d] -= c.channel.size[d] * std::floor(p[d] / c.channel.size[d]);
  const analysis::ChannelBox box{{c.channel.size[0], c.channel.size[1], c.channel.size[2]}, false};
  for (const int times : analysis::enclosure(points, triangles, box)) EXPECT_EQ(times, 0);
}

TEST(Placement, ABodyInsideAnotherIsNotAPlace) {
  // A white cell is wide enough for a platelet that touches none of its vertices: only the shapes'
  // own inside tests keep it out. In a box just larger than the white cell there is no other place.
  auto c = case_::read_case(HEMOMAG_SOURCE_DIR "/examples/margination_demo.toml", {});
  c.channel.size = {11e-6, 11e-6, 11e-6};
  c.carriers.clear();
  auto white = case_::standard_cell(case_::CellKind::white);
  white.count = 1, white.vertices = 642, white.placement = case_::Placement::grid;
  auto platelet = case_::standard_cell(case_::CellKind::platelet);
  platelet.count = 1, platelet.vertices = 162, platelet.diameter = 7e-6, platelet.thickness = 7e-6;
  platelet.placement = case_::Placement::grid;  // one place: the middle of the box
  c.cells = {platelet, white};
  EXPECT_THROW(case_::place(c), Error);
  c.cells = {white};
  EXPECT_EQ(case_::place(c).cells.size(), 1u);
}

TEST(CellModels, KnowTheirInsideTheirSizeAndWhatAVertexStandsFor) {
  auto c = case_::read_case(HEMOMAG_SOURCE_DIR "/examples/margination_demo.toml", {});
  const auto path = write_surface(membrane::evened_mesh(membrane::spheroid(2, 1.2), 200, 1));
  auto platelet = case_::standard_cell(case_::CellKind::platelet);
  auto white = case_::standard_cell(case_::CellKind::white);
  white.vertices = 642;
  case_::Cell own;
  own.mesh = path, own.mesh_unit = 2e-6, own.surface = case_::read_cell_surface(path);
  own.vertices = 200;
  std::filesystem::remove(path);
  c.cells = {c.cells[0], platelet, white, own};
  const auto models = case_::cell_models(c);
  const double um = 1e-6;
  const auto inside = [&](std::size_t m, double x, double y, double z) {
    return models[m].contains({x * um, y * um, z * um});
  };
  EXPECT_TRUE(inside(0, 2.7, 0, 1.0) && !inside(0, 0, 0, 0.5)) << "the dimple is outside";
  EXPECT_TRUE(inside(1, 1.2, 0, 0) && !inside(1, 1.3, 0, 0));
  EXPECT_TRUE(inside(1, 0, 0, 0.45) && !inside(1, 0, 0, 0.55));
  EXPECT_TRUE(inside(2, 0, 0, 4.9) && !inside(2, 3, 3, 3));
  EXPECT_TRUE(inside(3, 1.9, 0, 0) && !inside(3, 0, 0, 1.3)) << "about its centre, in its unit";
  // The vertices stand off the shape by edge^2/8 times the mean curvature, under 3 % of the size.
  const double reach[] = {3.91, 1.25, 5, 2};
  for (std::size_t m = 0; m < 4; ++m) {
    EXPECT_NEAR(models[m].reach, reach[m] * um, 0.03 * reach[m] * um) << m;
    EXPECT_GT(models[m].volume, 0);
    EXPECT_EQ(models[m].prestress.largest, 0) << "springs at rest in the mesh";
  }
  EXPECT_DOUBLE_EQ(models[0].vertex_share, 3286.0 / 642);
  EXPECT_NEAR(models[2].vertex_share, 100 * M_PI / 134.09 * 3286 / 642, 1e-3);
  EXPECT_NEAR(models[2].volume, M_PI / 6 * 1e-15, 1e-9 * 1e-15) << "10 um across";
}

/// The tube of examples/tube_flow.toml with more in it.
TEST(Placement, InATubeCellsAndCarriersKeepTheirGapFromTheWall) {
  for (const char* axis : {"x", "y", "z"}) {
    // 18 um fit into either cross-section of 20 by 22 and 22 um.
    const auto c = case_::read_case(HEMOMAG_SOURCE_DIR "/examples/tube_flow.toml",
                                    {std::string("channel.axis=") + axis, "channel.diameter=18 um",
                                     "cell.count=8", "carrier.count=200"});
    const auto system = case_::place(c);
    ASSERT_EQ(system.cells.size(), 8u);
    ASSERT_EQ(system.carriers.size(), 200u);
    const auto radius = [&](Vec3 x) {
      x -= 0.5 * Vec3{c.channel.size[0], c.channel.size[1], c.channel.size[2]};
      x[static_cast<std::size_t>(axis[0] - 'x')] = 0;
      return norm(x);
    };
    double cell = 0, carrier = 0, closest = 1;
    for (const auto& a : system.cells) {
      for (const Vec3& x : a.x) cell = std::max(cell, radius(x));
      for (const auto& p : system.carriers)
        for (const Vec3& x : a.x) {
          Vec3 d = x - p.beads[0];
          for (std::size_t k = 0; k < 3; ++k)
            d[k] -= c.channel.size[k] * std::round(d[k] / c.channel.size[k]);
          closest = std::min(closest, norm(d));
        }
    }
    for (const auto& p : system.carriers) carrier = std::max(carrier, radius(p.beads[0]));
    EXPECT_LE(cell, 9e-6 - 0.3e-6);
    EXPECT_LE(carrier, 9e-6 - 0.25e-6);
    EXPECT_GT(carrier, 8e-6) << "carriers are found in the whole tube";
    EXPECT_GE(closest, 0.56e-6);
  }
}

TEST(Placement, AGridInATubeTakesOnlyThePlacesThatFit) {
  // Flat cells of 7.82 um have 2 x 3 x 7 places in a box of 22 x 25 x 22 um. Their centres stand
  // 5.5 um beside the axis, so that only those of the middle layer lie inside a tube of 20 um.
  const auto with = [](int count) {
    return case_::place(
        case_::read_case(HEMOMAG_SOURCE_DIR "/examples/tube_flow.toml",
                         {"channel.size=[\"22 um\", \"25 um\", \"22 um\"]", "cell.placement=grid",
                          "cell.count=" + std::to_string(count)}));
  };
  const auto system = with(6);
  ASSERT_EQ(system.cells.size(), 6u);
  for (const auto& cell : system.cells)
    for (const Vec3& x : cell.x) EXPECT_LE(std::hypot(x.x - 11e-6, x.z - 11e-6), 10e-6 - 0.3e-6);
  EXPECT_THROW(with(7), Error) << "more than fit into the tube";
  EXPECT_THROW(with(43), Error) << "more than the box has places";
}

TEST(Placement, InVoxelsCellsLieAcrossTheOpenEnds) {
  // A square duct of 10.4 um along y that sticks out of a box of 12 x 9 x 12 um at both ends.
  const auto path = std::filesystem::temp_directory_path() /
                    ("hemomag_duct_" + std::to_string(getpid()) + ".off");
  std::ofstream(path) << "OFF\n8 12 0\n"
                         "0.8 -5 0.8\n11.2 -5 0.8\n11.2 -5 11.2\n0.8 -5 11.2\n"
                         "0.8 14 0.8\n11.2 14 0.8\n11.2 14 11.2\n0.8 14 11.2\n"
                         "3 0 1 2\n3 0 2 3\n3 4 6 5\n3 4 7 6\n3 0 5 1\n3 0 4 5\n"
                         "3 1 6 2\n3 1 5 6\n3 2 7 3\n3 2 6 7\n3 3 4 0\n3 3 7 4\n";
  auto c = case_::read_case(
      HEMOMAG_SOURCE_DIR "/examples/tube_flow.toml",
      {"channel.size=[\"22 um\", \"9 um\", \"22 um\"]", "cell.count=2", "carrier.count=100"});
  c.channel.size = {12e-6, 9e-6, 12e-6};
  c.channel.boundary = case_::Boundary::voxels;
  c.channel.geometry = path.string();
  c.channel.geometry_unit = 1e-6;
  c.vessel = case_::make_vessel(c);
  std::filesystem::remove(path);
  EXPECT_EQ(c.vessel.fluid_nodes, 20 * 18 * 20) << "of 0.5 um between 0.8 and 11.2";
  bool across = false;
  for (c.seed = 1; c.seed < 6; ++c.seed) {
    const auto system = case_::place(c);
    ASSERT_EQ(system.cells.size(), 2u);
    const auto gap = [](const Vec3& x) {
      return 5.2e-6 - std::max(std::fabs(x.x - 6e-6), std::fabs(x.z - 6e-6));
    };
    for (const auto& cell : system.cells)
      for (const Vec3& x : cell.x) {
        EXPECT_GE(gap(x), 0.3e-6 - 1e-15);
        across = across || x.y < 0 || x.y > 9e-6;
      }
    for (const auto& p : system.carriers) EXPECT_GE(gap(p.beads[0]), 0.25e-6 - 1e-15);
  }
  EXPECT_TRUE(across) << "some cell reaches into the next period";
}

}  // namespace
