// hemomag pack: the same bytes on any ranks and instruction set, and a run that uses them again.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Pack : public testing::Test {
protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() / ("hemomag_pack_" + std::to_string(getpid()));
    fs::create_directories(directory_);
    write("case.toml", "\"compress\"");
  }
  void TearDown() override { fs::remove_all(directory_); }

  void write(const std::string& name, const std::string& placement) const {
    std::ofstream(directory_ / name) << R"(
[channel]
size = ["11 um", "12 um", "10 um"]
shear_rate = "200 s-1"
[fluid]
viscosity = "1.2 mPa.s"
[numerics]
dx = "0.5 um"
[[cell]]
vertices = 362
hematocrit = 0.3
placement = )" << placement << R"(
[[carrier]]
count = 5
[run]
steps = 200
[output]
fields = "never"
)";
  }
  int run(const std::string& command) {
    const std::string line = "cd " + directory_.string() + " && " + command + " 2>&1";
    std::FILE* pipe = popen(line.c_str(), "r");
    said_.clear();
    std::array<char, 512> buffer;
    while (std::fgets(buffer.data(), buffer.size(), pipe)) said_ += buffer.data();
    return WEXITSTATUS(pclose(pipe));
  }
  fs::path directory_;
  std::string said_;
};

TEST_F(Pack, GivesTheSameBytesOnAnyRanksAndInstructionSet) {
  ASSERT_EQ(run(HEMOMAG_BINARY " pack case.toml --out one"), 0) << said_;
  EXPECT_NE(said_.find("4 cells (compress)"), std::string::npos) << said_;
  const auto report = nlohmann::json::parse(content(directory_ / "one" / "pack.json"));
  EXPECT_EQ(report["cells"], 4);
  EXPECT_EQ(report["crossings"], 0);
  EXPECT_GT(report["smallest_gap_um"], 0.1);
  EXPECT_LT(report["volume_change_max"], 0.01);
  EXPECT_GT(report["seconds"], 0);

  ASSERT_EQ(run("mpirun -np 2 " HEMOMAG_BINARY " pack case.toml --out two"), 0) << said_;
  ASSERT_EQ(run("HEMOMAG_SIMD=sse2 " HEMOMAG_BINARY " pack case.toml --out three"), 0) << said_;
  const std::string packed = content(directory_ / "one" / "packed.data");
  EXPECT_GT(packed.size(), 100000u);
  EXPECT_TRUE(packed == content(directory_ / "two" / "packed.data"));
  EXPECT_TRUE(packed == content(directory_ / "three" / "packed.data"));
}

TEST_F(Pack, IsUsedAgainByARunThatStaysSound) {
  ASSERT_EQ(run(HEMOMAG_BINARY " pack case.toml --out one"), 0) << said_;
  ASSERT_EQ(run(HEMOMAG_BINARY " run case.toml --out direct"), 0) << said_;
  write("again.toml", "{ file = \"one/packed.data\" }");
  ASSERT_EQ(run(HEMOMAG_BINARY " run again.toml --out again"), 0) << said_;
  EXPECT_NE(said_.find("4 cells (file)"), std::string::npos) << said_;
  const auto end = nlohmann::json::parse(content(directory_ / "again" / "summary.json"));
  EXPECT_EQ(end["cells_end"], 4);
  EXPECT_EQ(end["carriers_inside_max"], 0);
  EXPECT_LT(end["area_drift_max"], 0.05);
  EXPECT_EQ(content(directory_ / "again" / "packed.data"),
            content(directory_ / "one" / "packed.data"));
  // Its own directory holds all that is needed to run it once more.
  ASSERT_EQ(run(HEMOMAG_BINARY " run again/case.toml --out once_more"), 0) << said_;
  EXPECT_EQ(content(directory_ / "once_more" / "cells.data"),
            content(directory_ / "again" / "cells.data"));
}

TEST_F(Pack, RefusesWhatIsNotPacked) {
  write("case.toml", "\"random\"");
  EXPECT_EQ(run(HEMOMAG_BINARY " pack case.toml --out one"), 2);
  EXPECT_EQ(said_.rfind("case.toml:12:13: cell.placement: nothing is packed", 0), 0u) << said_;
  EXPECT_FALSE(fs::exists(directory_ / "one"));
  fs::create_directories(directory_ / "kept");
  write("case.toml", "\"compress\"");
  EXPECT_EQ(run(HEMOMAG_BINARY " pack case.toml --out kept"), 2);
  EXPECT_NE(said_.find("exists already"), std::string::npos) << said_;
}

}  // namespace
