// The starting state: how many, how far apart, and carriers outside cells.
#include <cmath>

#include <gtest/gtest.h>

#include "analysis/inside.hpp"
#include "case/case_file.hpp"
#include "case/placement.hpp"

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

}  // namespace
