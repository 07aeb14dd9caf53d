// Packed states: counts, gaps, the same again, kept and read back.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "analysis/inside.hpp"
#include "base/error.hpp"
#include "case/case_file.hpp"
#include "case/packed_file.hpp"
#include "case/packing.hpp"
#include "case/placement.hpp"
#include "case/vessel.hpp"
#include "membrane/mesh_map.hpp"

namespace {

using namespace hemomag;
using Overrides = std::vector<std::string>;

/// Cells of few vertices in a small channel.
case_::Case small(const Overrides& overrides) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("hemomag_small_" + std::to_string(getpid()) + ".toml");
  std::ofstream(path) << R"([channel]
size = ["11 um", "12 um", "10 um"]
[fluid]
viscosity = "1.2 mPa.s"
[numerics]
dx = "0.5 um"
dt = "5 us"
[[cell]]
vertices = 362
placement = "compress"
[run]
steps = 10
)";
  auto c = case_::read_case(path.string(), overrides);
  std::filesystem::remove(path);
  return c;
}

void expect_sound(const case_::System& s, std::size_t cells) {
  ASSERT_EQ(s.cells.size(), cells);
  ASSERT_TRUE(s.packing);
  EXPECT_EQ(s.packing->cells, cells);
  EXPECT_EQ(s.packing->crossings, 0);
  EXPECT_GT(s.packing->smallest_gap, 0.1e-6) << "half the range of the repulsion";
  EXPECT_LT(s.packing->area_change, 0.01);
  EXPECT_LT(s.packing->volume_change, 0.01);
}

TEST(Packing, CompressionMeetsTheHematocritToTheCell) {
  const auto c = small({"cell.hematocrit=0.30"});
  const auto s = case_::place(c);
  expect_sound(s, 4);
  EXPECT_NEAR(s.packing->hematocrit, 4 * s.models[0].volume / case_::fluid_volume(c), 1e-12);
  EXPECT_NEAR(s.packing->hematocrit, 0.285, 0.002) << "the nearest number of cells";
  EXPECT_GT(s.packing->wall_gap, 0.2e-6);
  for (const auto& cell : s.cells)
    for (const Vec3& x : cell.x) EXPECT_TRUE(x.z > 0 && x.z < 10e-6);
}

TEST(Packing, TheSameSeedGivesTheSameBytesAndAnotherDoesNot) {
  const auto c = small({"cell.count=3"});
  const auto models = case_::cell_models(c);
  const auto a = case_::pack_cells(c, models), b = case_::pack_cells(c, models);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(a.cells[k].x, b.cells[k].x);
  auto other = c;
  other.seed = 2;
  EXPECT_NE(case_::pack_cells(other, case_::cell_models(other)).cells[0].x, a.cells[0].x);
}

TEST(Packing, GrowthFillsPlatesAndPeriodicBoxes) {
  expect_sound(case_::place(small({"cell.hematocrit=0.30", "cell.placement=grow"})), 4);
  const auto s = case_::place(small(
      {"cell.hematocrit=0.35", "cell.placement=grow", "seed=2", "channel.boundary=periodic"}));
  expect_sound(s, 5);
  EXPECT_TRUE(std::isinf(s.packing->wall_gap));
}

TEST(Packing, GrowthFillsATubeAndCarriersAreOutside) {
  const auto c = case_::read_case(HEMOMAG_SOURCE_DIR "/examples/tube_flow.toml",
                                  {"channel.size=[\"16 um\", \"12 um\", \"16 um\"]",
                                   "channel.diameter=14 um", "cell.placement=grow",
                                   "cell.vertices=362", "cell.count=6", "carrier.count=50"});
  const auto s = case_::place(c);
  expect_sound(s, 6);
  EXPECT_GT(s.packing->wall_gap, 0.2e-6);
  ASSERT_EQ(s.carriers.size(), 50u);
  for (const auto& p : s.carriers) {
    EXPECT_GE(case_::wall_distance(c, p.beads[0]), 0.25e-6);
    for (const auto& cell : s.cells)
      for (const Vec3& x : cell.x) {
        Vec3 d = x - p.beads[0];
        for (std::size_t k = 0; k < 3; ++k)
          d[k] -= c.channel.size[k] * std::round(d[k] / c.channel.size[k]);
        EXPECT_GE(norm(d), 0.56e-6);
      }
  }
}

TEST(Packing, GrowthFillsAVesselOfVoxelsAndWormsAreOutside) {
  auto c = case_::read_case(HEMOMAG_SOURCE_DIR "/examples/stenosis.toml",
                            {"carrier.kind=worm", "carrier.beads=8", "carrier.count=20"});
  auto red = case_::standard_cell(case_::CellKind::rbc);
  red.count = 16, red.vertices = 242;
  red.placement = case_::Placement::grow;
  c.cells.push_back(red);
  const auto s = case_::place(c);
  expect_sound(s, 16);
  EXPECT_GT(s.packing->wall_gap, 0.2e-6);
  for (const auto& cell : s.cells)
    for (const Vec3& x : cell.x) EXPECT_GT(case_::wall_distance(c, x), 0.2e-6);

  std::vector<Vec3> beads;
  for (const auto& worm : s.carriers) {
    ASSERT_EQ(worm.beads.size(), 8u);
    for (const Vec3& x : worm.beads) {
      EXPECT_GE(case_::wall_distance(c, x), 0.25e-6);
      beads.push_back(1e6 * x);
    }
  }
  ASSERT_EQ(beads.size(), 160u);
  std::vector<analysis::SurfaceTriangle> triangles;
  std::int64_t before = 0;
  for (const auto& cell : s.cells) {
    for (const auto& t : s.models[cell.model].mesh.triangles) {
      auto& triangle = triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.x[k] = 1e6 * cell.x[static_cast<std::size_t>(t[k])];
        triangle.tag[k] = before + t[k];
      }
    }
    before += static_cast<std::int64_t>(cell.x.size());
  }
  const Vec3 box{24, 48, 24};
  for (const int times : analysis::enclosure(beads, triangles, {box, true})) EXPECT_EQ(times, 0);
}

TEST(Packing, KindsArePackedTogether) {
  auto c = small({"cell.count=2"});
  auto platelet = case_::standard_cell(case_::CellKind::platelet);
  platelet.count = 6, platelet.vertices = 200;
  platelet.placement = case_::Placement::compress;
  c.cells.push_back(platelet);
  expect_sound(case_::place(c), 8);
}

TEST(Packing, AFinerMeshIsCarriedFromTheCoarse) {
  const auto s = case_::place(small({"cell.count=3", "cell.vertices=1200"}));
  expect_sound(s, 3);
  for (const auto& cell : s.cells) EXPECT_EQ(cell.x.size(), 1200u);
}

TEST(MeshMap, IsExactAtRestAndUnderARigidMotion) {
  const auto coarse = membrane::red_cell_mesh(362, 7.82, 1),
             fine = membrane::red_cell_mesh(900, 7.82, 2);
  const membrane::MeshMap map(coarse, fine);
  const auto same = map(coarse.x);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const auto turn = [&](const Vec3& p) {
    return Vec3{c * p.x - s * p.z + 3, p.y - 1, s * p.x + c * p.z + 2};
  };
  std::vector<Vec3> turned;
  for (const Vec3& p : coarse.x) turned.push_back(turn(p));
  const auto carried = map(turned);
  for (std::size_t v = 0; v < fine.x.size(); ++v) {
    EXPECT_LT(norm(same[v] - fine.x[v]), 1e-12);
    EXPECT_LT(norm(carried[v] - turn(fine.x[v])), 1e-12);
  }
}

TEST(Packing, OfNoCellsIsNone) {
  const auto s = case_::place(small({"cell.count=0"}));
  EXPECT_TRUE(s.cells.empty());
  EXPECT_FALSE(s.packing.has_value());
}

class PackedFile : public testing::Test {
protected:
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() / ("hemomag_packed_" + std::to_string(getpid()));
    const auto c = small({"cell.count=2"});
    system_ = case_::place(c);
    text_ = case_::packed_data(c, system_);
    write(text_);
  }
  void TearDown() override { std::filesystem::remove(path_); }
  void write(const std::string& text) const { std::ofstream(path_) << text; }
  case_::Case reading(Overrides more) const {
    more.push_back("cell.placement={file=\"" + path_.string() + "\"}");
    return small(more);
  }
  void refused(const std::string& says, Overrides more = {"cell.count=2"}) const {
    const auto c = reading(std::move(more));
    try {
      case_::place(c);
      ADD_FAILURE() << "accepted, expected: " << says;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("placement"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("accepted"), std::string::npos) << e.what();
    }
  }
  void refused_with(const std::string& from, const std::string& to, const std::string& says) const {
    std::string text = text_;
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write(text.replace(at, from.size(), to));
    refused(says);
  }
  std::filesystem::path path_;
  std::string text_;
  case_::System system_;
};

TEST_F(PackedFile, GivesTheStateBackAtAnyNodeSpacing) {
  for (const char* dx : {"0.5 um", "0.25 um"}) {
    const auto again = case_::place(reading({"cell.count=2", std::string("numerics.dx=") + dx}));
    ASSERT_EQ(again.cells.size(), 2u);
    double worst = 0;
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t v = 0; v < again.cells[k].x.size(); ++v)
        worst = std::max(worst, norm(again.cells[k].x[v] - system_.cells[k].x[v]));
    EXPECT_LT(worst, 1e-19) << "a few roundings of 20 um";
    ASSERT_TRUE(again.packing);
    EXPECT_NEAR(again.packing->smallest_gap, system_.packing->smallest_gap, 1e-15);
  }
}

TEST_F(PackedFile, OfAnotherCaseIsRefused) {
  refused("the case has 3 cells", {"cell.count=3"});
  refused("meshes of 796", {"cell.count=2", "cell.vertices=400"});
  refused("um long along x", {"cell.count=2", "channel.size=[\"12 um\", \"12 um\", \"10 um\"]"});
  refused("um long along z", {"cell.count=2", "channel.size=[\"11 um\", \"12 um\", \"12 um\"]"});
  refused("packed with seed 1, the case has 7", {"cell.count=2", "seed=7"});
}

TEST_F(PackedFile, ThatIsDamagedIsRefused) {
  refused_with("hemomag: packed", "LAMMPS data", "where 'hemomag:' must be");
  refused_with("dx_m 4", "dx_m -4", "not above 0");
  refused_with(" atoms", " items", "where 'atoms' must be");
  refused_with("\n2 1 1 ", "\n3 1 1 ", "not numbered in order");
  refused_with("\n2 1 1 ", "\n2 2 1 ", "not of the next cell");
  refused_with("\n2 1 1 ", "\n2 1 1 nan ", "out of bounds");
  refused_with("\n2 1 1 ", "\n2 1 1 xyz ", "is not a number");
  write(text_.substr(0, text_.find("Atoms") + 5000));
  refused("ends before");
  write("");
  refused("is empty");
  const auto first = text_.find("Atoms # molecular\n\n") + 19;
  const auto second = text_.find('\n', first);
  write(text_.substr(0, first) + "1 1 1 30 30 10 0 0 0" + text_.substr(second));
  refused("cross");
}

TEST(PackingErrors, SayWhereAndWhatIsAccepted) {
  const auto refused = [](const Overrides& more, const char* says) {
    try {
      case_::place(small(more));
      ADD_FAILURE() << "accepted, expected: " << says;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  };
  refused({"cell.count=12"}, "12 cells make a hematocrit of 0.855; accepted: at most 0.6");
  refused({"cell.count=4", "contact.cell_sigma=5 um"}, "failed: packing drew an edge");
  refused({"channel.boundary=periodic"}, "\"grow\"");
  refused({"cell.placement={file=\"nowhere.data\"}"}, "cannot be read");
  refused({"cell.placement={files=\"nowhere.data\"}"}, "{ file = ");
  refused({"cell.placement=file"}, "unknown");
}

}  // namespace
