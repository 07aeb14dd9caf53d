// A small tube with cells and carriers through the real program.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

const std::string tube_case = R"(title = "a small tube"
[channel]
size = ["13 um", "12 um", "13 um"]
boundary = "tube"
diameter = "12 um"
mean_velocity = "0.5 mm/s"
[fluid]
viscosity = "1.2 mPa.s"
[numerics]
dx = "0.5 um"
cell_reynolds = 0.25
[[cell]]
vertices = 642
count = 2
[[carrier]]
count = 20
radius = "125 nm"
[magnetic]
field = "gradient"
gradient = "-4000 T/m"
zero_at = ["0 um", "0 um", "13 um"]
[analysis]
layer = "1.5 um"
[run]
steps = 2000
[output]
fields = "never"
series = "0.5 ms"
)";

struct Outcome {
  int code;
  std::string said;
};

Outcome shell(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string said;
  std::array<char, 512> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe)) said += buffer.data();
  return {WEXITSTATUS(pclose(pipe)), said};
}

/// The number behind "key": in a flat JSON object.
double number(const std::string& json, const std::string& key) {
  const auto at = json.find('"' + key + "\":");
  EXPECT_NE(at, std::string::npos) << key;
  return at == std::string::npos ? 0 : std::strtod(json.c_str() + at + key.size() + 3, nullptr);
}

std::string content(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class TubeRun : public testing::Test {
protected:
  void SetUp() override {
    directory_ =
        std::filesystem::temp_directory_path() / ("hemomag_tube_" + std::to_string(getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  Outcome run(const std::string& text, const std::string& out) const {
    std::ofstream(directory_ / "case.toml") << text;
    return shell("cd " + directory_.string() +
                 " && mpirun -np 2 " HEMOMAG_BINARY " run case.toml --out " + out);
  }

  /// A run that went through: nothing beyond the wall (fix hemo/wall ends the run otherwise), as
  /// many cells and carriers at the end as at the start, and a probability in every row.
  void expect_sound(const std::filesystem::path& out) const {
    const std::string summary = content(out / "summary.json");
    for (const char* kind : {"cells", "carriers"})
      EXPECT_EQ(number(summary, std::string(kind) + "_end"),
                number(summary, std::string(kind) + "_start"));
    EXPECT_EQ(number(summary, "cells_end"), 2);
    EXPECT_EQ(number(summary, "carriers_end"), 20);
    EXPECT_EQ(number(summary, "carriers_inside_max"), 0);
    EXPECT_GT(number(summary, "mach_max"), 0.02) << "the fluid moves";
    EXPECT_LT(number(summary, "area_drift_max"), 0.05);
    EXPECT_LE(number(summary, "probability_end"), 1);
    std::ifstream csv(out / "margination.csv");
    std::string row;
    std::getline(csv, row);
    EXPECT_EQ(row, "time_s,in_layer,probability");
    int rows = 0;
    for (; std::getline(csv, row); ++rows) {
      double time, in_layer, probability;
      ASSERT_EQ(std::sscanf(row.c_str(), "%lf,%lf,%lf", &time, &in_layer, &probability), 3) << row;
      EXPECT_GE(in_layer, 0);
      EXPECT_LE(in_layer, 20);
    }
    EXPECT_GT(rows, 20);
  }

  std::filesystem::path directory_;
};

TEST_F(TubeRun, KeepsCellsAndCarriersInsideAndCountsThem) {
  const Outcome outcome = run(tube_case, "result");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  expect_sound(directory_ / "result");
}

TEST_F(TubeRun, VoxelsRunFromTheirOwnDirectory) {
  // A square duct of 12 um that sticks out of the box at both ends.
  std::filesystem::create_directories(directory_ / "shapes");
  std::ofstream(directory_ / "shapes" / "duct.off")
      << "OFF\n8 12 0\n"
         "0.5 -5 0.5\n12.5 -5 0.5\n12.5 -5 12.5\n0.5 -5 12.5\n"
         "0.5 17 0.5\n12.5 17 0.5\n12.5 17 12.5\n0.5 17 12.5\n"
         "3 0 1 2\n3 0 2 3\n3 4 6 5\n3 4 7 6\n3 0 5 1\n3 0 4 5\n"
         "3 1 6 2\n3 1 5 6\n3 2 7 3\n3 2 6 7\n3 3 4 0\n3 3 7 4\n";
  std::string text = tube_case;
  const std::string from = "boundary = \"tube\"\ndiameter = \"12 um\"\n";
  text.replace(text.find(from), from.size(),
               "boundary = \"voxels\"\ngeometry = \"shapes/duct.off\"\n");
  const Outcome outcome = run(text, "result");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  expect_sound(directory_ / "result");
  // The surface travels with the run: the script and the case run again from the directory alone.
  EXPECT_EQ(content(directory_ / "result" / "geometry.off"),
            content(directory_ / "shapes" / "duct.off"));
  std::filesystem::remove_all(directory_ / "shapes");
  const std::string there = "cd " + (directory_ / "result").string() + " && ";
  const Outcome script =
      shell(there + "sed -i 's/^run .*/run 10/' in.lammps && mpirun -np 2 " HEMOMAG_BINARY
                    " lmp -log none -in in.lammps");
  EXPECT_EQ(script.code, 0) << script.said;
  const Outcome again = shell(there + HEMOMAG_BINARY " check case.toml");
  EXPECT_EQ(again.code, 0) << again.said;
}

/// What a script with one atom in a tube of radius 8 along y says at its end; empty when it runs.
std::string script_says(const std::filesystem::path& directory, const std::string& atom,
                        const std::string& rest) {
  const auto file = directory / "in.script";
  std::ofstream(file) << "units lj\natom_style molecular\nnewton on\nboundary p p p\n"
                         "region b block 0 20 0 12 0 20\ncreate_box 1 b\nmass * 1\n"
                         "neighbor 1.0 bin\ntimestep 1.0\npair_style zero 1\npair_coeff * *\n"
                         "create_atoms 1 single "
                      << atom << "\n"
                      << rest << "\nrun 0\n";
  const Outcome outcome =
      shell("mpirun -np 2 " HEMOMAG_BINARY " lmp -log none -in " + file.string());
  return outcome.code == 0 ? std::string() : outcome.said;
}

TEST_F(TubeRun, FixHemoWallSaysWhatIsWrong) {
  const std::string wall = "fix wall all hemo/wall 0.01 0.5 0.56\n";
  const std::string tube = "fix fluid all hemo/fluid tau 1 tube y 10 10 8\n";
  const auto expect = [&](const std::string& said, std::vector<std::string> words) {
    for (const auto& word : words)
      EXPECT_NE(said.find(word), std::string::npos) << word << " is not in: " << said;
  };
  EXPECT_EQ(script_says(directory_, "10 6 10", wall + tube), "");
  expect(script_says(directory_, "10 6 18.5", wall + tube),
         {"fix hemo/wall", "step 0", "atom 1", "18.5", "beyond the vessel's wall"});
  expect(script_says(directory_, "10 6 10", wall + "fix fluid all hemo/fluid tau 1\n"),
         {"fix hemo/wall", "no vessel"});
  expect(script_says(directory_, "10 6 10", wall), {"needs a fix hemo/fluid"});
  expect(script_says(directory_, "10 6 10", "fix wall all hemo/wall 0.01 0.5\n" + tube),
         {"EPSILON SIGMA CUTOFF"});
  expect(script_says(directory_, "10 6 10", "fix wall all hemo/wall 0.01 0 0.5\n" + tube),
         {"above 0"});
  expect(script_says(directory_, "10 6 10", tube + wall), {"must be the last fix"});
  expect(script_says(directory_, "10 6 10",
                     "compute m all hemo/margination layer 1 walls vessel\n"
                     "thermo_style custom step c_m[1]\nfix fluid all hemo/fluid tau 1\n"),
         {"compute hemo/margination", "tube or surface"});
}

}  // namespace
