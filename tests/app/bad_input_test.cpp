// Malformed case files through the real program: exit code 2, one line with file, line, column, key
// and what is accepted, and nothing written.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

const std::string good = R"(title = "case"
[channel]
size = ["8 um", "8 um", "8 um"]
shear_rate = "200 s-1"
[fluid]
viscosity = "1.2 mPa.s"
[numerics]
dx = "0.5 um"
[[carrier]]
count = 3
radius = "125 nm"
[magnetic]
B0 = "0.05 T"
[run]
steps = 10
)";

struct Outcome {
  int code;
  std::string error;
};

class BadInput : public testing::Test {
protected:
  void SetUp() override {
    directory_ =
        std::filesystem::temp_directory_path() / ("hemomag_bad_" + std::to_string(getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  /// `good` with one piece of text replaced.
  static std::string changed(const std::string& from, const std::string& to) {
    std::string text = good;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }

  Outcome run(const std::string& text, const std::string& options = "") {
    std::ofstream(directory_ / "case.toml") << text;
    return run_file("case.toml", options);
  }

  Outcome run_file(const std::string& name, const std::string& options = "") {
    const std::string command = "cd " + directory_.string() + " && " HEMOMAG_BINARY " run " + name +
                                " --out result " + options + " 2>&1 >/dev/null";
    std::FILE* pipe = popen(command.c_str(), "r");
    std::string error;
    std::array<char, 512> buffer;
    while (std::fgets(buffer.data(), buffer.size(), pipe)) error += buffer.data();
    const int status = pclose(pipe);
    return {WEXITSTATUS(status), error};
  }

  void refused(const std::string& text, const std::string& place, const std::string& says,
               const std::string& options = "") {
    const Outcome outcome = run(text, options);
    EXPECT_EQ(outcome.code, 2) << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_EQ(outcome.error.rfind(place, 0), 0u)
        << "expected " << place << " got " << outcome.error;
    EXPECT_NE(outcome.error.find(says), std::string::npos)
        << "expected " << says << " got " << outcome.error;
    const bool says_what = outcome.error.find("accepted") != std::string::npos ||
                           outcome.error.find("expected") != std::string::npos ||
                           outcome.error.find("required") != std::string::npos;
    EXPECT_TRUE(says_what) << outcome.error;
    EXPECT_FALSE(std::filesystem::exists(directory_ / "result"));
  }

  std::filesystem::path directory_;
};

TEST_F(BadInput, WrongTypesAndUnits) {
  refused(changed("\"125 nm\"", "125"), "case.toml:11:10: carrier.radius:", "without a unit");
  refused(changed("\"125 nm\"", "\"125\""), "case.toml:11:10: carrier.radius:", "has no unit");
  refused(changed("\"125 nm\"", "\"125 s\""),
          "case.toml:11:10: carrier.radius:", "is not a length");
  refused(changed("\"125 nm\"", "\"125 nn\""), "case.toml:11:10: carrier.radius:", "is not a unit");
  refused(changed("\"125 nm\"", "\"1-2 nm\""), "case.toml:11:10: carrier.radius:", "is not a unit");
  refused(changed("\"125 nm\"", "\"125 nm since 2000\""),
          "case.toml:11:10: carrier.radius:", "is not a unit");
  refused(changed("\"125 nm\"", "\"nm\""),
          "case.toml:11:10: carrier.radius:", "does not begin with a number");
  refused(changed("\"200 s-1\"", "\"200 rpm\""),
          "case.toml:4:14: channel.shear_rate:", "is not a unit");
  refused(changed("count = 3", "count = 3.5"), "case.toml:10:9: carrier.count:", "a whole number");
  refused(changed("count = 3", "count = \"3\""),
          "case.toml:10:9: carrier.count:", "a whole number");
  refused(changed("\"case\"", "7"), "case.toml:1:9: title:", "a string");
  refused(changed("[\"8 um\", \"8 um\", \"8 um\"]", "\"8 um\""),
          "case.toml:3:8: channel.size:", "three of a length");
  refused(changed("[\"8 um\", \"8 um\", \"8 um\"]", "[\"8 um\", \"8 um\"]"),
          "case.toml:3:8: channel.size:", "three of a length");
  refused(changed("[\"8 um\", \"8 um\"", "[\"8 um\", \"8 K\""),
          "case.toml:3:17: channel.size:", "is not a length");
}

TEST_F(BadInput, OutOfRange) {
  refused(changed("\"125 nm\"", "\"-125 nm\""), "case.toml:11:10: carrier.radius:", "out of range");
  refused(changed("\"125 nm\"", "\"0 nm\""), "case.toml:11:10: carrier.radius:", "out of range");
  refused(changed("count = 3", "count = -3"), "case.toml:10:9: carrier.count:", "out of range");
  refused(changed("dx = \"0.5 um\"", "dx = \"0.5 um\"\ntau = 0.5"),
          "case.toml:9:7: numerics.tau:", "out of range");
  refused(changed("steps = 10", "steps = 0"), "case.toml:15:9: run.steps:", "out of range");
  refused(changed("dx = \"0.5 um\"", "dx = \"0.3 um\""),
          "case.toml:3:8: channel.size:", "whole multiple of dx");
  refused(changed("viscosity = \"1.2 mPa.s\"", "viscosity = \"inf Pa.s\""),
          "case.toml:6:13: fluid.viscosity:", "number");
}

TEST_F(BadInput, KeysThatAreNotOrAreMissing) {
  refused(changed("radius =", "raduis ="),
          "case.toml:11:10: carrier.raduis:", "did you mean radius?");
  refused(changed("[magnetic]", "[magnetics]"),
          "case.toml:12:1: magnetics:", "did you mean magnetic?");
  refused(changed("viscosity = \"1.2 mPa.s\"\n", ""),
          "case.toml:5:1: fluid.viscosity:", "is missing");
  refused(changed("dx = \"0.5 um\"\n", ""), "case.toml:7:1: numerics.dx:", "is missing");
  refused(changed("steps = 10\n", ""), "case.toml:14:1: run.time:", "is missing");
  refused(
      changed("[channel]\nsize = [\"8 um\", \"8 um\", \"8 um\"]\nshear_rate = \"200 s-1\"\n", ""),
      "case.toml:1:1: channel.size:", "is missing");
  refused(changed("shear_rate = \"200 s-1\"\n", ""), "case.toml:6:1: numerics.dt:", "is missing");
  refused(changed("count = 3", "count = 3\ncount = 4"), "case.toml:11:", "syntax:");
  refused(changed("[run]", "[run"), "case.toml:14:5: syntax:", "TOML");
  refused(changed("[[carrier]]", "[carrier]"), "case.toml:9:1: carrier:", "[[carrier]] entries");
}

TEST_F(BadInput, Contradictions) {
  refused(changed("steps = 10", "steps = 10\ntime = \"1 s\""),
          "case.toml:15:9: run.steps:", "excludes");
  refused(changed("dx = \"0.5 um\"", "dx = \"0.5 um\"\ndt = \"1 us\"\ncell_reynolds = 0.5"),
          "case.toml:9:6: numerics.dt:", "excludes");
  refused(
      changed("[[carrier]]", "[[cell]]\nvertices = 642\ncount = 1\nhematocrit = 0.1\n[[carrier]]"),
      "case.toml:11:9: cell.count:", "excludes");
  refused(changed("shear_rate = \"200 s-1\"", "shear_rate = \"200 s-1\"\nboundary = \"periodic\""),
          "case.toml:4:14: channel.shear_rate:", "plates");
}

TEST_F(BadInput, FeaturesOfLaterVersions) {
  refused(changed("dx = \"0.5 um\"", "dx = \"0.5 um\"\nscheme = \"exponential\""),
          "case.toml:9:10: numerics.scheme:", "not available in this version");
  refused(changed("dx = \"0.5 um\"", "dx = \"0.5 um\"\nprecision = \"single\""),
          "case.toml:9:13: numerics.precision:", "not available");
  refused(changed("B0 = \"0.05 T\"", "field = \"rotating\""),
          "case.toml:13:9: magnetic.field:", "not available");
  refused(changed("shear_rate", "boundary = \"tube\"\nshear_rate"),
          "case.toml:4:12: channel.boundary:", "not available");
  refused(changed("[run]", "[analysis]\nlayer = \"measured\"\n[run]"),
          "case.toml:15:9: analysis.layer:", "not available");
  refused(changed("[[carrier]]", "[[cell]]\nplacement = \"compress\"\n[[carrier]]"),
          "case.toml:10:13: cell.placement:", "not available");
}

TEST_F(BadInput, Overrides) {
  refused(good, "--set carrier.radius:", "is not a length", "--set 'carrier.radius=3 s'");
  refused(good, "--set carrier.radus:", "is not a key", "--set 'carrier.radus=3 nm'");
  refused(good, "--set nonsense:", "has no value", "--set nonsense");
  refused(good, "--set carrier.7.radius:", "entries", "--set 'carrier.7.radius=3 nm'");
}

TEST_F(BadInput, UnreadableFile) {
  const Outcome outcome = run_file("absent.toml");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.error.rfind("absent.toml:1:1: ", 0), 0u) << outcome.error;
}

TEST_F(BadInput, WhatCannotWorkIsRefusedByTheCard) {
  const std::string worm = "kind = \"worm\"\nbeads = 8\ncount = 3";
  refused(changed("radius = \"125 nm\"", "radius = \"800 nm\""),
          "case.toml:9:1: carrier:", "a larger dx");
  refused(changed("count = 3", worm), "case.toml:9:1: carrier:", "the largest stable stretching");
  refused(changed("shear_rate = \"200 s-1\"", "shear_rate = \"200 s-1\"\n[contact]\nepsilon = 0"),
          "case.toml:6:11: contact.epsilon:", "out of range");
  // A field that is too strong breaks several limits at once: one line for each.
  const Outcome outcome = run(changed("\"0.05 T\"", "\"2 T\""));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.error.find("case.toml:9:1: carrier: drift"), std::string::npos)
      << outcome.error;
  EXPECT_NE(outcome.error.find("at most"), std::string::npos) << outcome.error;
  EXPECT_FALSE(std::filesystem::exists(directory_ / "result"));
}

TEST_F(BadInput, TooManyCells) {
  refused(changed("[[carrier]]",
                  "[[cell]]\nvertices = 642\ncount = 9\nplacement = \"grid\"\n[[carrier]]"),
          "case.toml:12:13: cell.placement:", "of 9 cells");
}

TEST_F(BadInput, AnExistingDirectoryIsKept) {
  std::filesystem::create_directories(directory_ / "result");
  std::ofstream(directory_ / "result" / "precious") << "data";
  EXPECT_EQ(run(good).code, 2);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "result" / "precious"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "result" / "case.toml"));
}

TEST_F(BadInput, ARunThatBreaksOffExitsWithThreeAndSaysWhy) {
  // An absurd attraction between two cells: the fluid passes its speed limit.
  const Outcome outcome = run(
      changed("[[carrier]]", "[[cell]]\nvertices = 642\ncount = 2\nplacement = \"grid\"\n"
                             "[contact]\nmorse_depth = 1e9\nmorse_cutoff = \"3 um\"\n[[carrier]]"),
      "--set 'channel.size=[\"9 um\", \"9 um\", \"9 um\"]'");
  EXPECT_EQ(outcome.code, 3) << outcome.error;
  EXPECT_NE(outcome.error.find("the run broke off: ERROR"), std::string::npos) << outcome.error;
  EXPECT_TRUE(std::filesystem::exists(directory_ / "result" / "log.lammps"));
}

TEST_F(BadInput, TheGoodFileIsGood) {
  const Outcome outcome = run(good);
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_TRUE(std::filesystem::exists(directory_ / "result" / "summary.json"));
}

}  // namespace
