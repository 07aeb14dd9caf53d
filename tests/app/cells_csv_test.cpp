// cells.csv of a sheared cell through the real program, on two ranks.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

const std::string sheared_cell = R"(title = "a cell in shear"
[channel]
size = ["12 um", "12 um", "12 um"]
shear_rate = "200 s-1"
plates = "symmetric"
[fluid]
viscosity = "1.2 mPa.s"
[numerics]
dx = "0.5 um"
dt = "6.8135e-6 s"
[[cell]]
vertices = 642
count = 1
placement = "grid"
[run]
steps = 2400
[output]
)";

using Row = std::map<std::string, double>;

class CellsCsv : public testing::Test {
protected:
  void SetUp() override {
    directory_ =
        std::filesystem::temp_directory_path() / ("hemomag_cells_" + std::to_string(getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  /// Run the case with lines added to its [output].
  void run(const std::string& output) const {
    std::ofstream(directory_ / "case.toml") << sheared_cell + output;
    const std::string command = "cd " + directory_.string() +
                                " && mpirun -np 2 " HEMOMAG_BINARY
                                " run case.toml --out out > said 2>&1";
    ASSERT_EQ(WEXITSTATUS(std::system(command.c_str())), 0)
        << std::ifstream(directory_ / "said").rdbuf();
  }

  std::vector<Row> rows() const {
    std::ifstream file(directory_ / "out" / "cells.csv");
    std::string line, word;
    std::vector<std::string> names;
    std::getline(file, line);
    for (std::istringstream words(line); std::getline(words, word, ',');) names.push_back(word);
    std::vector<Row> table;
    while (std::getline(file, line)) {
      std::istringstream words(line);
      Row row;
      for (const auto& name : names)
        if (std::getline(words, word, ',')) row[name] = std::stod(word);
      table.push_back(row);
    }
    return table;
  }

  std::filesystem::path directory_;
};

TEST_F(CellsCsv, FollowsAShearedCellAcrossThePeriodicBorder) {
  run("fields = \"never\"\ncells = \"1 ms\"\n");
  const auto table = rows();
  ASSERT_EQ(table.size(), 1u + 2400 / 147) << "1 ms is 147 steps";
  double least_y = 1e9;
  for (std::size_t k = 0; k < table.size(); ++k) {
    Row row = table[k];
    EXPECT_EQ(row["cell"], 1);
    EXPECT_NEAR(row["time_s"], static_cast<double>(147 * k) * 6.8135e-6, 1e-8);
    EXPECT_NEAR(row["volume_um3"], 94.1, 0.01 * 94.1);
    EXPECT_NEAR(row["area_um2"], 134.1, 0.02 * 134.1) << "642 vertices, sheared";
    EXPECT_GE(row["a_um"], row["b_um"]);
    EXPECT_GE(row["b_um"], row["c_um"]);
    least_y = std::min(least_y, row["y_um"]);
    if (k < 2) continue;  // the flow takes a first moment to get hold of the cell
    Row before = table[k - 1];
    EXPECT_LT(row["phase_deg"], before["phase_deg"]) << "vorticity is along -x";
    EXPECT_LT(row["treading_deg"], before["treading_deg"]);
    const double moved_mm_per_s =
        1e-3 * (row["y_um"] - before["y_um"]) / (row["time_s"] - before["time_s"]);
    EXPECT_NEAR(moved_mm_per_s, (row["vy_mm_per_s"] + before["vy_mm_per_s"]) / 2, 0.01)
        << "the centre moves as the mean of the vertices does, but for a changing shape";
  }
  EXPECT_LT(least_y, 0) << "the cell must leave the box, and y_um with it";
}

TEST_F(CellsCsv, IsWrittenAsOftenAsFieldsUnlessItSaysOtherwise) {
  run("fields = \"4 ms\"\n");
  EXPECT_EQ(rows().size(), 1u + 2400 / 587) << "4 ms is 587 steps";
  std::filesystem::remove_all(directory_ / "out");
  run("fields = \"4 ms\"\ncells = \"never\"\n");
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out" / "cells.csv"));
}

}  // namespace
