// A measured cell-free layer and profiles through the real program, during the run and from files.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace {

const std::string four_cells = R"(title = "four cells"
[channel]
size = ["12 um", "12 um", "12 um"]
shear_rate = "200 s-1"
[fluid]
viscosity = "1.2 mPa.s"
[numerics]
dx = "0.5 um"
dt = "6.25 us"
[[cell]]
vertices = 642
count = 4
[[carrier]]
count = 10
radius = "125 nm"
[magnetic]
B0 = "0.05 T"
[analysis]
layer = "measured"
layer_run = "1 ms"
[run]
steps = 160
[output]
profiles = "0.5 ms"
fields = "0.5 ms"
)";

class ProfilesRun : public testing::Test {
protected:
  void SetUp() override {
    directory_ =
        std::filesystem::temp_directory_path() / ("hemomag_layer_" + std::to_string(getpid()));
    std::filesystem::create_directories(directory_);
    std::ofstream(directory_ / "case.toml") << four_cells;
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  int hemomag(const std::string& arguments) {
    said_.clear();
    std::FILE* pipe = popen(
        ("cd " + directory_.string() + " && " + HEMOMAG_BINARY + " " + arguments + " 2>&1").c_str(),
        "r");
    std::array<char, 512> buffer;
    while (std::fgets(buffer.data(), buffer.size(), pipe)) said_ += buffer.data();
    return WEXITSTATUS(pclose(pipe));
  }

  std::string content(const std::string& name) const {
    std::stringstream text;
    text << std::ifstream(directory_ / name).rdbuf();
    return text.str();
  }

  std::vector<std::vector<double>> rows(const std::string& name) const {
    std::ifstream file(directory_ / name);
    std::string line;
    std::getline(file, line);
    std::vector<std::vector<double>> table;
    while (std::getline(file, line)) {
      std::stringstream cells(line);
      table.emplace_back();
      for (std::string cell; std::getline(cells, cell, ',');)
        table.back().push_back(std::stod(cell));
    }
    return table;
  }

  std::filesystem::path directory_;
  std::string said_;
};

TEST_F(ProfilesRun, MeasuresTheLayerFirstAndAgreesWithItsSnapshots) {
  ASSERT_EQ(hemomag("run case.toml --out run"), 0) << said_;
  const auto alone = nlohmann::json::parse(content("run/layer/summary.json"));
  EXPECT_EQ(alone["carriers_start"], 0);
  EXPECT_EQ(alone["cells_end"], 4);
  const double layer_um = alone["profiles"]["layer_um"];
  EXPECT_GT(layer_um, 0);
  EXPECT_LT(layer_um, 6);
  char line[96];
  std::snprintf(line, sizeof line, "hemo/margination layer %.6g", layer_um / 0.5);
  EXPECT_NE(content("run/in.lammps").find(line), std::string::npos) << line;
  // What the layer's run says of itself is that run.
  ASSERT_EQ(hemomag("check run/layer/case.toml"), 0) << said_;

  // 80 and 160 steps: the same from the run and from the snapshots of those times.
  const auto during = rows("run/layer.csv");
  ASSERT_EQ(during.size(), 2u);
  ASSERT_EQ(hemomag("profiles run --from 0.0004"), 0) << said_;
  const auto after = rows("run/layer_of_fields.csv");
  ASSERT_EQ(after.size(), 3u);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t column = 0; column < 5; ++column)
      EXPECT_NEAR(after[k + 1][column], during[k][column], 1e-7 * 12) << k << " " << column;
  const auto here = rows("run/profiles.csv"), there = rows("run/profiles_of_fields.csv");
  ASSERT_EQ(here.size(), 24u);
  ASSERT_EQ(there.size(), 24u);
  double hematocrit = 0;
  for (std::size_t k = 0; k < 24; ++k) {
    for (std::size_t column = 0; column < 5; ++column)
      EXPECT_NEAR(there[k][column], here[k][column], 1e-6) << k << " " << column;
    hematocrit += here[k][1] / 24;
  }
  EXPECT_NEAR(hematocrit, 4 * 93.3 / (12 * 12 * 12), 0.01);
}

TEST_F(ProfilesRun, SaysWhatIsMissing) {
  EXPECT_EQ(hemomag("profiles nowhere"), 2);
  EXPECT_NE(said_.find("nowhere/fields/fluid.vtkhdf.series: is missing"), std::string::npos);
}

TEST_F(ProfilesRun, EndsWithALineOnWhatNobodyForesaw) {
  EXPECT_EQ(hemomag("profiles " + std::string(5000, 'x')), 4);
  EXPECT_NE(said_.find("hemomag: filesystem error"), std::string::npos) << said_;
  EXPECT_EQ(said_.find("terminate called"), std::string::npos) << said_;
}

}  // namespace
