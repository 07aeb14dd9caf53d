// Malformed case files through the real program: exit code 2, one line with file, line, column, key
// and what is accepted, and nothing written.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
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

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// FILE:LINE:COL, or the override at fault; the key, or what is wrong with the file; the rest.
const std::regex form(R"((case\.toml:[1-9]\d*:[1-9]\d*: |--set )[^ :]+: [^\n]+)");

/// Every line of an error says where, which key, what is wrong and what is accepted.
void expect_lines_of_the_form(const std::string& error) {
  std::istringstream lines(error);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(std::regex_match(line, form)) << line;
    const bool says_what_is_accepted = line.find("accepted") != std::string::npos ||
                                       line.find("expected") != std::string::npos ||
                                       line.find("required") != std::string::npos;
    EXPECT_TRUE(says_what_is_accepted) << line;
  }
}

/// Malformed inputs that were refused as they must be: the case, its options and its files.
std::set<std::string> refused_inputs;

/// The promise of docs/reliability.md, counted when the executable runs as a whole, as under ctest.
class Count : public testing::Environment {
  void TearDown() override {
    if (GTEST_FLAG_GET(filter) != "*") return;
    std::printf("%zu distinct malformed inputs refused\n", refused_inputs.size());
    EXPECT_GE(refused_inputs.size(), 120u);
  }
};
const auto* const count = testing::AddGlobalTestEnvironment(new Count);

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
    return shell(HEMOMAG_BINARY " run " + name + " --out result " + options);
  }

  /// Run a command there. @return exit code and what it wrote to standard error
  Outcome shell(const std::string& line) {
    const std::string command = "cd " + directory_.string() + " && " + line + " 2>&1 >/dev/null";
    std::FILE* pipe = popen(command.c_str(), "r");
    std::string error;
    std::array<char, 512> buffer;
    while (std::fgets(buffer.data(), buffer.size(), pipe)) error += buffer.data();
    const int status = pclose(pipe);
    return {WEXITSTATUS(status), error};
  }

  /// @return the message
  std::string refused(const std::string& text, const std::string& place, const std::string& says,
                      const std::string& options = "") {
    const Outcome outcome = run(text, options);
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_EQ(outcome.error.rfind(place, 0), 0u)
        << "expected " << place << " got " << outcome.error;
    expect_refusal(outcome, says, text + options);
    return outcome.error;
  }

  /// What has no place in a case is refused with a line as well, and nothing is written.
  void expect_one_line(const Outcome& outcome, const std::string& says) {
    EXPECT_EQ(outcome.code, 2) << outcome.error;
    EXPECT_NE(outcome.error.find(says), std::string::npos) << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_FALSE(std::filesystem::exists(directory_ / "result"));
  }

  /// @param input  what was refused, beside the files of the directory
  void expect_refusal(const Outcome& outcome, const std::string& says, std::string input) {
    EXPECT_EQ(outcome.code, 2) << outcome.error;
    EXPECT_NE(outcome.error.find(says), std::string::npos)
        << "expected " << says << " got " << outcome.error;
    expect_lines_of_the_form(outcome.error);
    EXPECT_FALSE(std::filesystem::exists(directory_ / "result"));
    for (const auto& entry : std::filesystem::directory_iterator(directory_))
      if (entry.is_regular_file()) input += content(entry.path());
    if (!HasFailure()) refused_inputs.insert(input);
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

TEST_F(BadInput, ContactsThatDoNotGoTogether) {
  refused(changed("[run]", "[contact]\nsurface_range = \"0.2 um\"\n[run]"),
          "case.toml:15:17: contact.surface_range:", "needs carrier_contact = \"surface\"");
  refused(changed("[run]", "[contact]\ncarrier_contact = \"surface\"\ncarrier_sigma = \"0.4 um\"\n"
                           "[run]"),
          "case.toml:16:17: contact.carrier_sigma:", "is for carrier_contact = \"vertices\"");
  refused(changed("[run]", "[contact]\ncarrier_contact = \"edges\"\n[run]"),
          "case.toml:15:19: contact.carrier_contact:", "\"vertices\", \"surface\"");
  refused(changed("[[carrier]]", "[[cell]]\nvertices = 642\ncount = 1\n[[carrier]]") +
              "[contact]\ncarrier_contact = \"surface\"\nsurface_stiffness = \"1 N/m\"\n",
          "case.toml:12:1: carrier:", "surface_stiffness");
}

TEST_F(BadInput, FeaturesOfLaterVersions) {
  refused(changed("[[carrier]]", "[[cell]]\nplacement = \"dense\"\n[[carrier]]"),
          "case.toml:10:13: cell.placement:", "\"grow\"");
}

/// `good` with other lines in place of its shear rate, and no default gradient.
std::string channel_with(const std::string& lines) {
  std::string text = good;
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"shear_rate = \"200 s-1\"\n", lines},
        {"B0 = \"0.05 T\"", "field = \"none\""}}) {
    const auto at = text.find(from);
    text.replace(at, from.size(), to);
  }
  return text;
}

const std::string tube = "boundary = \"tube\"\ndiameter = \"7 um\"\nmean_velocity = \"1 mm/s\"\n";

TEST_F(BadInput, LayersAndProfilesThatCannotBeMeasured) {
  refused(changed("[run]", "[analysis]\nlayer = \"measured\"\n[run]"),
          "case.toml:15:9: analysis.layer:", "needs plates and a [[cell]]");
  refused(changed("[run]", "[analysis]\nlayer = \"thick\"\n[run]"),
          "case.toml:15:9: analysis.layer:", "a length is expected");
  refused(changed("[run]", "[analysis]\nlayer_run = \"0.1 s\"\n[run]"),
          "case.toml:15:13: analysis.layer_run:", "needs layer = \"measured\"");
  const std::string with_cell = "[[cell]]\nvertices = 642\ncount = 1\n[[carrier]]";
  std::string text = changed("[[carrier]]", with_cell);
  refused(text + "[analysis]\nlayer = \"measured\"\nlayer_run = \"0 s\"\n",
          "case.toml:21:13: analysis.layer_run:", "above 0");
  refused(changed("[run]", "[output]\nprofiles = \"1 um\"\n[run]"),
          "case.toml:15:12: output.profiles:", "a time is expected");
  text = channel_with("boundary = \"periodic\"\n");
  text.replace(text.find("dx = \"0.5 um\""), 0, "dt = \"6 us\"\n");
  refused(text + "[output]\nprofiles = \"1 ms\"\n",
          "case.toml:18:12: output.profiles:", "needs boundary = \"plates\"");
}

// The key at fault is not in the file: its table is pointed at.
TEST_F(BadInput, DefaultsThatDoNotGoWithTheRest) {
  refused(changed("count = 3", "feedback = false\n[[carrier]]"),
          "case.toml:11:1: carrier.1.feedback:", "differs from another");
  refused(channel_with("boundary = \"tube\"\ndiameter = \"5 um\"\nmean_velocity = \"1 mm/s\"\n"),
          "case.toml:1:1: analysis.layer:", "half its width");
}

TEST_F(BadInput, Tubes) {
  const auto with = [](const std::string& lines) { return channel_with(tube + lines); };
  refused(channel_with("boundary = \"tube\"\n"), "case.toml:2:1: channel.diameter:", "is missing");
  refused(channel_with("boundary = \"tube\"\ndiameter = \"7.5 um\"\nmean_velocity = \"1 mm/s\"\n"),
          "case.toml:5:12: channel.diameter:", "at most 7 um");
  refused(channel_with("boundary = \"tube\"\ndiameter = \"0 um\"\n"),
          "case.toml:5:12: channel.diameter:", "out of range");
  refused(with("axis = \"w\"\n"), "case.toml:7:8: channel.axis:", "\"x\", \"y\", \"z\"");
  refused(with("plates = \"symmetric\"\n"), "case.toml:7:10: channel.plates:", "leave it out");
  refused(with("geometry = \"a.stl\"\n"), "case.toml:7:12: channel.geometry:", "voxels");
  refused(with("geometry_unit = \"1 mm\"\n"), "case.toml:7:17: channel.geometry_unit:", "voxels");
  refused(channel_with("boundary = \"tube\"\ndiameter = \"7 um\"\nshear_rate = \"200 s-1\"\n"),
          "case.toml:6:14: channel.shear_rate:", "plates");
  refused(channel_with("boundary = \"tube\"\ndiameter = \"7 um\"\n"),
          "case.toml:8:1: numerics.dt:", "mean_velocity");
  refused(channel_with("boundary = \"tube\"\ndiameter = \"7 um\"\n"),
          "--set numerics.cell_reynolds:", "means nothing", "--set numerics.cell_reynolds=0.5");
  refused(with(""), "--set analysis.walls:", "\"vessel\"", "--set analysis.walls=lower");
  refused(with(""), "--set analysis.walls:", "\"vessel\"", "--set analysis.walls=both");
  refused(with(""), "--set analysis.layer:", "half its width", "--set 'analysis.layer=3.5 um'");
  refused(with(""), "case.toml:14:1: magnetic.gradient:", "without plates",
          "--set magnetic.field=gradient");
  refused(with(""), "--set channel.size:", "whole multiple of dx",
          "--set 'channel.size=[\"8 um\", \"8.2 um\", \"8 um\"]'");
  refused(with("[[cell]]\nvertices = 642\ncount = 1\nplacement = \"grid\"\n"),
          "case.toml:10:13: cell.placement:", "of 1 cells");
}

TEST_F(BadInput, KeysOfVesselsElsewhere) {
  const std::string plates = "shear_rate = \"200 s-1\"\n";
  refused(channel_with(plates + "axis = \"x\"\n"), "case.toml:5:8: channel.axis:", "along y");
  refused(channel_with(plates + "diameter = \"7 um\"\n"),
          "case.toml:5:12: channel.diameter:", "tube");
  refused(channel_with(plates + "geometry = \"a.stl\"\n"),
          "case.toml:5:12: channel.geometry:", "voxels");
  refused(channel_with(plates), "--set analysis.walls:", "\"lower\", \"both\"",
          "--set analysis.walls=vessel");
}

TEST_F(BadInput, MeanVelocities) {
  const std::string mean = "mean_velocity = \"1 mm/s\"\n";
  refused(channel_with(mean + "shear_rate = \"200 s-1\"\n"),
          "case.toml:4:17: channel.mean_velocity:", "excludes shear_rate");
  refused(channel_with(mean + "body_force = \"2e4 N/m3\"\n"),
          "case.toml:4:17: channel.mean_velocity:", "excludes body_force");
  refused(channel_with(mean + "boundary = \"periodic\"\n"),
          "case.toml:4:17: channel.mean_velocity:", "walls");
  refused(channel_with("mean_velocity = \"1 mm\"\n"),
          "case.toml:4:17: channel.mean_velocity:", "is not a velocity");
  refused(channel_with("mean_velocity = \"0 mm/s\"\n"),
          "case.toml:4:17: channel.mean_velocity:", "out of range");
}

TEST_F(BadInput, NumbersOfTheSchemes) {
  const auto with = [](const std::string& line) {
    return changed("dx = \"0.5 um\"", "dx = \"0.5 um\"\n" + line);
  };
  refused(with("tau = 0.3"), "case.toml:9:7: numerics.tau:", "exponential");
  refused(with("scheme = \"exponential\"\ntau = 0.04"),
          "case.toml:10:7: numerics.tau:", "at least 0.05");
  refused(with("scheme = \"mrt\""), "case.toml:9:10: numerics.scheme:", "\"exponential\"");
  refused(with("precision = \"half\""), "case.toml:9:13: numerics.precision:", "\"single\"");
  refused(with("kernel = \"roma4\""), "case.toml:9:10: numerics.kernel:", "\"roma3\"");
}

TEST_F(BadInput, Surfaces) {
  const auto with = [&](const std::string& lines) {
    return channel_with("boundary = \"voxels\"\nmean_velocity = \"1 mm/s\"\n" + lines);
  };
  const auto surface = [&](const std::string& points, const std::string& triangles) {
    std::ofstream(directory_ / "wall.off") << points << triangles;
  };
  const std::string file = "geometry = \"wall.off\"\n";
  const std::string tetrahedron = "OFF\n4 4 0\n1 1 1\n7 1 1\n1 7 1\n1 1 7\n";
  const std::string faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  refused(with(""), "case.toml:2:1: channel.geometry:", "is missing");
  refused(with("geometry = 3\n"), "case.toml:6:12: channel.geometry:", "a string");
  refused(with(file), "case.toml:6:12: channel.geometry:", "wall.off");
  surface("OFF\nfour\n", "");
  refused(with(file), "case.toml:6:12: channel.geometry:", "wall.off");
  surface("OFF\n4 3 0\n1 1 1\n7 1 1\n1 7 1\n1 1 7\n", "3 0 2 1\n3 0 1 3\n3 0 3 2\n");
  refused(with(file), "case.toml:6:12: channel.geometry:", "wall.off");
  surface(tetrahedron, faces);
  refused(with(file + "geometry_unit = \"1 nm\"\n"),
          "case.toml:6:12: channel.geometry:", "no node");
  refused(with(file + "geometry_unit = \"1\"\n"),
          "case.toml:7:17: channel.geometry_unit:", "has no unit");
  refused(with(file + "diameter = \"5 um\"\n"), "case.toml:7:12: channel.diameter:", "tube");
  // A closed vessel has no way through along which a mean velocity could be held.
  refused(with(file), "case.toml:2:1: channel: open ends", "along y");
}

TEST_F(BadInput, KindsOfCells) {
  const auto with = [](const std::string& lines) {
    return changed("[[carrier]]", "[[cell]]\n" + lines + "\n[[carrier]]");
  };
  const std::string platelet = "kind = \"platelet\"\ncount = 1\n",
                    white = "kind = \"white\"\ncount = 1\n";
  refused(with("kind = \"virus\""), "case.toml:10:8: cell.kind:", "\"platelet\", \"white\"");
  refused(with("kind = \"platelet\""), "case.toml:9:1: cell.count:", "is missing");
  refused(with("kind = \"white\""), "case.toml:9:1: cell.count:", "is missing");
  refused(with(platelet + "vertices = 161"), "case.toml:12:12: cell.vertices:", "at least 162");
  refused(with(platelet + "diameter = \"0 um\""),
          "case.toml:12:12: cell.diameter:", "out of range");
  refused(with(platelet + "diameter = 2.5"), "case.toml:12:12: cell.diameter:", "without a unit");
  refused(with(platelet + "thickness = \"3 um\""),
          "case.toml:12:13: cell.thickness:", "at most the diameter, 2.5 um");
  refused(with(platelet + "thickness = \"0.4 um\""),
          "case.toml:12:13: cell.thickness:", "at least 0.5 um");
  refused(with(platelet + "diameter = \"6 um\""),
          "case.toml:12:12: cell.diameter:", "leaves the thickness at 1 um");
  refused(with(platelet + "stress_free = \"sphere\""),
          "case.toml:12:15: cell.stress_free:", "red cells");
  refused(with(white + "thickness = \"1 um\""), "case.toml:12:13: cell.thickness:", "platelets");
  refused(with("diameter = \"8 um\"\ncount = 1"), "case.toml:10:12: cell.diameter:", "7.82 um");
  refused(with("thickness = \"2 um\"\ncount = 1"), "case.toml:10:13: cell.thickness:", "platelets");
  refused(with("mesh_unit = \"1 mm\"\ncount = 1"),
          "case.toml:10:13: cell.mesh_unit:", "needs mesh");
  refused(with("stress_free = \"cube\"\ncount = 1"),
          "case.toml:10:15: cell.stress_free:", "\"sphere\"");
  refused(with(white + "vertices = 162"), "case.toml:9:1: cell: cell size", "less than the box");
  refused(with("stress_free = \"sphere\"\nstretch_ratio = 0.85\ncount = 1\nvertices = 642"),
          "case.toml:9:1: cell: prestress", "l/l_max");
}

TEST_F(BadInput, SurfacesOfCells) {
  const auto with = [](const std::string& lines) {
    return changed("[[carrier]]", "[[cell]]\ncount = 1\n" + lines + "\n[[carrier]]");
  };
  const auto surface = [&](const std::string& text) {
    std::ofstream(directory_ / "cell.off") << text;
  };
  const std::string points = "1 1 1\n3 1 1\n1 3 1\n1 1 3\n";
  const std::string faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const std::string file = "mesh = \"cell.off\"";
  const std::string at = "case.toml:11:8: cell.mesh:";
  refused(with("mesh = 3"), at, "a string");
  refused(with(file), at, "cell.off: cannot be read");
  refused(with("mesh = \".\""), at, "cannot be read");
  surface("OFF\nfour\n");
  refused(with(file), at, "cell.off");
  surface("OFF\n4 3 0\n" + points + "3 0 2 1\n3 0 1 3\n3 0 3 2\n");
  refused(with(file), at, "cell.off");
  surface("OFF\n8 8 0\n" + points + "6 1 1\n8 1 1\n6 3 1\n6 1 3\n" + faces +
          "3 4 6 5\n3 4 5 7\n3 4 7 6\n3 5 6 7\n");
  refused(with(file), at, "2 pieces");
  surface("OFF\n4 4 0\n" + points + faces);
  refused(with(file + "\nvertices = 642"), "case.toml:12:12: cell.vertices:", "excludes mesh");
  refused(with(file + "\ndiameter = \"3 um\""), "case.toml:12:12: cell.diameter:", "excludes mesh");
  refused(with(file + "\nthickness = \"3 um\""),
          "case.toml:12:13: cell.thickness:", "excludes mesh");
  refused(with(file + "\nmesh_unit = \"1 s\""), "case.toml:12:13: cell.mesh_unit:", "length");
  refused(with(file + "\nstress_free = \"sphere\""),
          "case.toml:12:15: cell.stress_free:", "without a mesh");
  refused(changed("[[carrier]]", "[[cell]]\nhematocrit = 0.3\nmesh = \"cell.off\"\nmesh_unit = "
                                 "\"1 nm\"\n[[carrier]]"),
          "case.toml:10:14: cell.hematocrit:", "accepted: at most 1e+07");
  // A unit that was mistaken: too large for the box, and for the nodes.
  const std::string mistaken = with(file + "\nmesh_unit = \"1 mm\"");
  const Outcome outcome = run(mistaken);
  expect_refusal(outcome, "case.toml:9:1: cell: cell size", mistaken);
  EXPECT_NE(outcome.error.find("see cell.diameter or cell.mesh_unit"), std::string::npos);
}

TEST_F(BadInput, ASurfaceOfOnesOwnRunsAndItsDirectoryIsTheRun) {
  // A cube of 2 um, each face a fan about its middle: 14 vertices.
  std::filesystem::create_directories(directory_ / "shapes");
  std::ofstream(directory_ / "shapes" / "cube.off")
      << "OFF\n14 24 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n"
         "1 1 0\n1 1 2\n1 0 1\n1 2 1\n0 1 1\n2 1 1\n"
         "3 0 3 8\n3 3 2 8\n3 2 1 8\n3 1 0 8\n3 4 5 9\n3 5 6 9\n3 6 7 9\n3 7 4 9\n"
         "3 0 1 10\n3 1 5 10\n3 5 4 10\n3 4 0 10\n3 2 3 11\n3 3 7 11\n3 7 6 11\n3 6 2 11\n"
         "3 0 4 12\n3 4 7 12\n3 7 3 12\n3 3 0 12\n3 1 2 13\n3 2 6 13\n3 6 5 13\n3 5 1 13\n";
  const Outcome first = run(
      changed("[[carrier]]",
              "[[cell]]\ncount = 2\nmesh = \"shapes/cube.off\"\nkind = \"white\"\n[[carrier]]"));
  EXPECT_EQ(first.code, 0) << first.error;
  const auto read = [&](const std::string& name) { return content(directory_ / name); };
  EXPECT_EQ(read("result/cell.off"), read("shapes/cube.off"));
  EXPECT_NE(read("result/cells.data").find("31 atoms"), std::string::npos) << "2 x 14 and 3";
  const auto data = read("result/cells.data");
  std::filesystem::remove_all(directory_ / "shapes");
  std::filesystem::rename(directory_ / "result", directory_ / "kept");
  const Outcome again = run_file("kept/case.toml");
  EXPECT_EQ(again.code, 0) << again.error;
  EXPECT_EQ(read("result/cells.data"), data);
}

TEST_F(BadInput, Overrides) {
  refused(good, "--set carrier.radius:", "is not a length", "--set 'carrier.radius=3 s'");
  refused(good, "--set carrier.radus:", "is not a key", "--set 'carrier.radus=3 nm'");
  refused(good, "--set nonsense:", "has no value", "--set nonsense");
  refused(good, "--set carrier.7.radius:", "entries", "--set 'carrier.7.radius=3 nm'");
  refused(good, "--set carrier..radius:", "is not a key", "--set 'carrier..radius=3 nm'");
  refused(good, "--set .radius:", "is not a key", "--set '.radius=3 nm'");
}

/// `good` with other lines in place of its field, the first of which is on line 13.
std::string field_with(const std::string& lines) {
  std::string text = good;
  return text.replace(text.find("B0 = \"0.05 T\""), std::string("B0 = \"0.05 T\"").size(), lines);
}

const std::string block = "field = \"magnet\"\nposition = [\"4 um\", \"4 um\", \"-1 mm\"]\n"
                          "remanence = \"0.2 T\"\nsize = [\"1 mm\", \"1 mm\", \"1 mm\"]\n";
const std::string rod = "field = \"magnet\"\nposition = [\"4 um\", \"4 um\", \"-1 mm\"]\n"
                        "remanence = \"0.2 T\"\nshape = \"cylinder\"\ndiameter = \"1 mm\"\n"
                        "length = \"1 mm\"\n";
const std::string coil = "field = \"coil\"\nposition = [\"4 um\", \"4 um\", \"-1 mm\"]\n"
                         "current = \"1 A\"\ndiameter = \"1 mm\"\n";

TEST_F(BadInput, UnitsAndOverridesInDisguise) {
  refused(changed("\"125 nm\"", "\"125 nm FROM2\""),
          "case.toml:11:10: carrier.radius:", "is not a unit");
  refused(good, "--set run.steps.:", "is not a key", "--set 'run.steps.=20'");
  refused(good, "--set seed=3:", "has a line break", "--set 'seed=3\nrun.steps=4'");
  refused(changed("title = \"case\"", "seed = 9007199254740993\ntitle = \"case\""),
          "case.toml:1:8: seed:", "out of range");
  refused(changed("\"case\"", "\"two\\nlines\""), "case.toml:1:9: title:", "of several lines");
}

TEST_F(BadInput, LengthsMistakenInTheirUnit) {
  for (const char* key : {"carrier_sigma", "morse_cutoff", "cell_sigma", "plate_sigma"})
    refused(good + "[contact]\n" + key + " = \"1 mm\"\n",
            "case.toml:17:", std::string("contact.") + key + ": reaches across the channel");
  refused(good + "[contact]\nmorse_cutoff = \"0.4 um\"\n",
          "case.toml:17:16: contact.morse_cutoff:", "the well's minimum");
  refused(good + "[analysis]\nwalls = \"both\"\nlayer = \"4 um\"\n",
          "case.toml:18:9: analysis.layer:", "leaves nothing between");
}

TEST_F(BadInput, StepsThatNoNumberHolds) {
  refused(good, "--set numerics.cell_reynolds:", "gives steps of",
          "--set numerics.cell_reynolds=1e300");
  refused(good, "--set numerics.dt:", "gives steps of", "--set 'numerics.dt=1e-300 s'");
  refused(field_with("field = \"uniform\"\ntime = \"sine\"\nfrequency = \"100 kHz\"\n"),
          "case.toml:", "steps a turn", "");
  refused(field_with(coil), "case.toml:12:1: magnetic:", "not finite",
          "--set 'magnetic.current=1e300 A' --set magnetic.turns=1000000");
}

TEST_F(BadInput, CellsThatAreNoneOrTooMany) {
  const std::string one = "[[cell]]\nvertices = 642\n";
  refused(good + one + "hematocrit = 1e-9\n", "case.toml:16:", "a hematocrit from");
  refused(good + one + "count = 10000000\n", "case.toml:16:", "a hematocrit up to 0.6");
  refused(good + one + "count = 1\nstretch_ratio = 0.001\n",
          "case.toml:19:17: cell.stretch_ratio:", "out of range");
}

TEST_F(BadInput, NoneOfACount) {
  for (const std::string& none :
       {good + "[[cell]]\ncount = 0\n", changed("count = 3", "count = 0"),
        good + "[[cell]]\nvertices = 642\ncount = 1\n[[cell]]\nkind = \"white\"\ncount = 0\n" +
            "diameter = \"5 um\"\n"}) {
    const Outcome outcome = run(none, "--force");
    EXPECT_EQ(outcome.code, 0) << none << outcome.error;
    EXPECT_EQ(run_file("case.toml", "--resume").code, 0);
  }
}

TEST_F(BadInput, CasesThatAreNoFiles) {
  shell("mkfifo pipe.toml; truncate -s 20M large.toml");
  for (const char* name : {"pipe.toml", "/dev/zero"})
    expect_one_line(run_file(name), ": cannot be read; a readable TOML file is expected");
  expect_one_line(run_file("large.toml"), ": has more than 10 MB; a TOML file is expected");
}

TEST_F(BadInput, OutputThatCannotBe) {
  shell("ln -s loop loop");
  for (const std::string& out : {std::string("loop"), std::string(300, 'x'),
                                 std::string("case.toml/run"), std::string("case.toml")}) {
    std::ofstream(directory_ / "case.toml") << good;
    expect_one_line(shell(HEMOMAG_BINARY " run case.toml --out " + out), "accepted");
  }
}

TEST_F(BadInput, InstructionsThatAreNone) {
  std::ofstream(directory_ / "case.toml") << good;
  expect_one_line(shell("HEMOMAG_SIMD=foo " HEMOMAG_BINARY " run case.toml --out result"),
                  "HEMOMAG_SIMD=foo: is unknown; accepted: sse2, avx2, avx512");
}

TEST_F(BadInput, ATableOfAnyNameWithAByteOrderMarkIsGood) {
  std::ofstream table(directory_ / "B.my $x #1 table");
  table << "\xEF\xBB\xBFx_m,y_m,z_m,Bx_T,By_T,Bz_T\n";
  for (int k = 0; k < 64; ++k)
    table << k % 4 * 3e-6 << "," << k / 4 % 4 * 3e-6 << "," << k / 16 * 3e-6 << ",0,0,0.05\n";
  table.close();
  const Outcome outcome = run(field_with("field = \"table\"\nfile = \"B.my $x #1 table\"\n"));
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_EQ(run_file("case.toml", "--resume").code, 0);
}

TEST_F(BadInput, GoodFields) {
  for (const std::string& lines :
       {block, rod, coil, coil + "pair = \"opposite\"\ndistance = \"1 mm\"\nturns = 3\n",
        block + "axis = [0, 1, 1]\nacross = \"x\"\nmagnetisation = \"y\"\ntime = \"sine\"\n"
                "frequency = \"100 Hz\"\n",
        std::string("field = \"wire\"\nposition = [\"4 um\", \"4 um\", \"-1 mm\"]\naxis = \"x\"\n"
                    "current = \"-1 A\"\ntime = \"pulse\"\nduration = \"1 ms\"\n"),
        std::string(
            "field = \"rotating\"\nfrequency = \"50 Hz\"\ntime = \"ramp\"\nduration = \"1 ms\"\n"),
        "dipoles = false\n[[magnetic.source]]\nfield = \"uniform\"\naxis = [1, 0, 1]\n"
        "[[magnetic.source]]\n" +
            rod}) {
    const Outcome outcome = run(field_with(lines), "--force --set run.steps=2");
    EXPECT_EQ(outcome.code, 0) << lines << outcome.error;
  }
}

TEST_F(BadInput, KeysOfFields) {
  const auto line = [](int n) { return "case.toml:" + std::to_string(n) + ":"; };
  const auto wrong = [&](const std::string& lines, int n, const std::string& key,
                         const std::string& says) {
    SCOPED_TRACE(lines);
    const std::string error = refused(field_with(lines), line(n), says);
    EXPECT_NE(error.find(" magnetic." + key + ":"), std::string::npos);
  };
  wrong("field = \"magnte\"\n", 13, "field", "is unknown");
  wrong("field = \"rotating\"\n", 12, "frequency", "is missing");
  wrong("field = \"rotating\"\nfrequency = \"10\"\n", 14, "frequency", "has no unit");
  wrong("field = \"rotating\"\nfrequency = \"10 rpm\"\n", 14, "frequency", "is not a unit");
  wrong("field = \"rotating\"\nfrequency = \"0 Hz\"\n", 14, "frequency", "out of range");
  wrong("field = \"rotating\"\nfrequency = \"9 Hz\"\nplane = \"xx\"\n", 15, "plane", "is unknown");
  wrong("field = \"rotating\"\nfrequency = \"9 Hz\"\ntime = \"sine\"\n", 15, "time",
        "excludes a rotating");
  wrong("frequency = \"9 Hz\"\n", 13, "frequency", "needs field = \"rotating\"");
  wrong("time = \"sine\"\n", 12, "frequency", "is missing");
  wrong("time = \"ramp\"\n", 12, "duration", "is missing");
  wrong("time = \"pulse\"\nduration = \"0 s\"\n", 14, "duration", "out of range");
  wrong("time = \"pulse\"\nduration = \"1 s\"\nstart = \"-1 s\"\n", 15, "start", "out of range");
  wrong("start = \"1 s\"\n", 13, "start", "needs time");
  wrong("time = \"square\"\n", 13, "time", "is unknown");
  wrong("field = \"none\"\ntime = \"ramp\"\n", 14, "time", "needs a field");
  wrong("field = \"quadrupole\"\n", 12, "gradient", "is missing");
  wrong("field = \"quadrupole\"\ngradient = \"5 T\"\n", 14, "gradient", "is not a field gradient");
  wrong("field = \"quadrupole\"\ngradient = \"5 T/m\"\nB0 = \"1 T\"\n", 15, "B0",
        "needs field = \"uniform\"");
  wrong("field = \"gradient\"\naxis = [0, 1, 1]\n", 14, "axis", "along one axis");
  wrong("field = \"uniform\"\naxis = [0, 0, 0]\n", 14, "axis", "has no direction");
  wrong("field = \"uniform\"\naxis = \"w\"\n", 14, "axis", "three numbers");
  wrong("field = \"uniform\"\naxis = [0, \"1\", 0]\n", 14, "axis", "three numbers");
  wrong("field = \"uniform\"\nremanence = \"1 T\"\n", 14, "remanence", "needs field = \"magnet\"");
}

TEST_F(BadInput, KeysOfMagnetsCoilsAndWires) {
  const auto cut = [](std::string text, const std::string& key) {
    const auto at = text.find(key + " = ");
    return text.erase(at, text.find('\n', at) + 1 - at);
  };
  const auto wrong = [&](const std::string& lines, const std::string& key,
                         const std::string& says) {
    SCOPED_TRACE(lines);
    const std::string error = refused(field_with(lines), "case.toml:", says);
    EXPECT_NE(error.find(" magnetic." + key + ":"), std::string::npos);
  };
  for (const char* key : {"position", "remanence", "size"})
    wrong(cut(block, key), key, "is missing");
  for (const char* key : {"diameter", "length"}) wrong(cut(rod, key), key, "is missing");
  for (const char* key : {"position", "current", "diameter"})
    wrong(cut(coil, key), key, "is missing");
  wrong(cut(block, "remanence") + "remanence = \"0.2 A\"\n", "remanence",
        "is not a magnetic field");
  wrong(cut(block, "remanence") + "remanence = \"0 T\"\n", "remanence", "out of range");
  wrong(cut(block, "size") + "size = [\"1 mm\", \"0 mm\", \"1 mm\"]\n", "size", "out of range");
  wrong(cut(block, "size") + "size = \"1 mm\"\n", "size", "three of a length");
  wrong(cut(block, "position") + "position = [\"1 mm\", \"0 mm\", 1]\n", "position",
        "without a unit");
  wrong(block + "diameter = \"1 mm\"\n", "diameter", "cylinder");
  wrong(block + "across = \"z\"\n", "across", "is along axis");
  wrong(block + "turns = 2\n", "turns", "needs field = \"coil\"");
  wrong(rod + "magnetisation = \"x\"\n", "magnetisation", "no closed form");
  wrong(rod + "size = [\"1 mm\", \"1 mm\", \"1 mm\"]\n", "size", "block");
  wrong(block + "shape = \"ball\"\n", "shape", "is unknown");
  wrong(cut(coil, "current") + "current = \"1 T\"\n", "current", "is not a current");
  wrong(coil + "turns = 0\n", "turns", "out of range");
  wrong(coil + "pair = \"same\"\n", "distance", "is missing");
  wrong(coil + "distance = \"1 mm\"\n", "distance", "needs pair");
  wrong(coil + "pair = \"two\"\n", "pair", "is unknown");
  wrong("dipoles = true\nB0 = \"1 T\"\n[[magnetic.source]]\nfield = \"uniform\"\n", "B0",
        "excludes");
  wrong("[[magnetic.source]]\ndipoles = false\n", "source.dipoles", "belongs to [magnetic]");
  wrong("[[magnetic.source]]\n" + coil + "[[magnetic.source]]\n" + cut(coil, "diameter"),
        "source.1.diameter", "is missing");
  wrong("source = 3\n", "source", "entries are expected");
  refused(changed("radius = ", "saturation_magnetisation = \"4 T\"\nradius = "),
          "case.toml:11:28: carrier.saturation_magnetisation:", "is not a magnetisation");
  refused(changed("radius = ", "saturation_magnetisation = \"0 A/m\"\nradius = "),
          "case.toml:11:28: carrier.saturation_magnetisation:", "out of range");
  refused(changed("radius = ",
                  "susceptibility = 0.0\nsaturation_magnetisation = \"9 kA/m\"\nradius = "),
          "case.toml:12:28: carrier.saturation_magnetisation:", "above 0");
}

TEST_F(BadInput, SourcesThatReachIntoTheChannel) {
  const auto moved = [](std::string text, const std::string& z) {
    return field_with(text.replace(text.find("-1 mm"), 5, z));
  };
  refused(moved(block, "0.4 mm"), "case.toml:12:1: magnetic:", "outside the box");
  refused(moved(rod, "-0.5 mm"), "case.toml:12:1: magnetic:", "outside the box");
  refused(field_with(
              "field = \"wire\"\nposition = [\"4 um\", \"4 um\", \"4 um\"]\ncurrent = \"1 A\"\n"),
          "case.toml:12:1: magnetic:", "outside the box");
  const std::string near = moved(block, "-501 um");
  expect_refusal(run(near, "--set 'magnetic.remanence=100 T'"), "drift", near);
}

TEST_F(BadInput, Tables) {
  const auto write = [&](double low, double step, const std::string& last) {
    std::ofstream file(directory_ / "B.csv");
    file << "x_m,y_m,z_m,Bx_T,By_T,Bz_T\n";
    for (int k = 0; k < 64; ++k)
      file << low + step * (k % 4) << "," << low + step * (k / 4 % 4) << ","
           << low + step * (k / 16) << (k < 63 ? ",0,0,0.01\n" : last);
  };
  const std::string table = field_with("field = \"table\"\nfile = \"B.csv\"\n");
  refused(field_with("field = \"table\"\n"), "case.toml:12:1: magnetic.file:", "is missing");
  refused(field_with("field = \"table\"\nfile = \"C.csv\"\n"),
          "case.toml:14:8: magnetic.file:", "cannot be read");
  write(0, 3e-6, ",0,0\n");
  refused(table, "case.toml:14:8: magnetic.file:", "B.csv: line 65: the row has 5 columns");
  write(0, 2e-6, ",0,0,0\n");
  refused(table, "case.toml:12:1: magnetic: table, ends inside the box", "covers the box");
  write(0, 3e-6, ",0,0,0\n");
  const Outcome outcome = run(table);
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_TRUE(std::filesystem::exists(directory_ / "result" / "magnetic.csv")) << "a copy";
  const std::string text = content(directory_ / "result" / "case.toml");
  EXPECT_NE(text.find("magnetic.csv"), std::string::npos) << text;
}

TEST_F(BadInput, UnreadableFile) {
  const Outcome outcome = run_file("absent.toml");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.error.rfind("absent.toml:1:1: ", 0), 0u) << outcome.error;
}

TEST_F(BadInput, Carriers) {
  refused(changed("count = 3", "count = 3\ndensity = \"900 kg/m3\""),
          "case.toml:11:11: carrier.density:", "is below the fluid's");
  refused(changed("count = 3", "count = 3\ndensity = \"5 kg\""),
          "case.toml:11:11: carrier.density:", "is not a density");
  refused(changed("[magnetic]", "[contact]\nrepulsion_kappa = 4\n[magnetic]"),
          "case.toml:13:19: contact.repulsion_kappa:", "out of range");
  refused(
      changed("[magnetic]", "[contact]\nrepulsion = \"paper\"\nrepulsion_kappa = 60\n[magnetic]"),
      "case.toml:14:19: contact.repulsion_kappa:", "leave it out");
}

TEST_F(BadInput, WhatCannotWorkIsRefusedByTheCard) {
  const std::string worm = "kind = \"worm\"\nbeads = 8\ncount = 3";
  refused(changed("radius = \"125 nm\"", "radius = \"800 nm\""),
          "case.toml:9:1: carrier:", "a larger dx");
  refused(changed("count = 3", worm), "case.toml:9:1: carrier:", "the largest stable stretching");
  refused(changed("shear_rate = \"200 s-1\"", "shear_rate = \"200 s-1\"\n[contact]\nepsilon = 0"),
          "case.toml:6:11: contact.epsilon:", "out of range");
  // A field that is too strong breaks several limits at once: one line for each.
  const std::string strong = changed("\"0.05 T\"", "\"2 T\"");
  const Outcome outcome = run(strong);
  expect_refusal(outcome, "case.toml:9:1: carrier: drift", strong);
  EXPECT_NE(outcome.error.find("at most"), std::string::npos) << outcome.error;
}

TEST_F(BadInput, TooManyCells) {
  refused(changed("[[carrier]]",
                  "[[cell]]\nvertices = 642\ncount = 3\nplacement = \"grid\"\n[[carrier]]"),
          "case.toml:12:13: cell.placement:", "of 3 cells");
}

TEST_F(BadInput, Packing) {
  const auto with = [](const std::string& cells) {
    return changed("[[carrier]]", cells + "\n[[carrier]]");
  };
  const std::string at = "case.toml:12:13: cell.placement:";
  const std::string few = "[[cell]]\nvertices = 200\ncount = 1\nplacement = ";
  refused(with(few + "\"dense\""), at, "accepted: \"random\", \"grid\", \"compress\", \"grow\"");
  refused(with(few + "3"), at, "a whole number is not what is meant here");
  refused(with(few + "{ path = \"packed.data\" }"), at, "{ file = ");
  refused(with(few + "{ file = 3 }"), at, "{ file = ");
  refused(with(few + "{ file = \"packed.data\", seed = 1 }"), at, "{ file = ");
  refused(with(few + "{ file = \"absent.data\" }"), at, "absent.data: cannot be read");
  std::ofstream(directory_ / "packed.data") << "LAMMPS data file\n\n12 atoms\n";
  refused(with(few + "{ file = \"packed.data\" }"), at,
          "line 1: 'LAMMPS' where 'hemomag:' must be");
  refused(with("[[cell]]\nvertices = 200\ncount = 9\nplacement = \"compress\""),
          "case.toml:9:1: cell:", "a hematocrit up to 0.6");
  refused(with(few + "\"compress\"\n" + few + "\"random\""),
          "case.toml:16:13: cell.1.placement:", "differs from another [[cell]]");
  refused(with(few + "\"compress\"\n[[cell]]\nvertices = 200\ncount = 1"),
          "case.toml:13:1: cell.1.placement:", "differs from another [[cell]]");
}

TEST_F(BadInput, MoreRanksThanTheChannelHasRoomFor) {
  std::ofstream(directory_ / "case.toml")
      << changed("\"8 um\", \"8 um\", \"8 um\"", "\"4 um\", \"4 um\", \"4 um\"");
  const auto [code, said] = shell("mpirun -np 16 " HEMOMAG_BINARY " run case.toml --out result");
  EXPECT_EQ(code, 2) << said;
  EXPECT_NE(said.find("case.toml:3:8: channel.size: leaves a rank a brick of 2 nodes along"),
            std::string::npos)
      << said;
  EXPECT_FALSE(std::filesystem::exists(directory_ / "result"));
}

/// A change of `good`, and how it is refused.
struct Malformed {
  const char *from, *to, *place, *says;
};

TEST_F(BadInput, UnitsOfAnotherDimensionMissingOrUnknown) {
  for (const auto& [from, to, place, says] : std::vector<Malformed>{
           {"1.2 mPa.s", "1.2 mPa", "6:13: fluid.viscosity", "is not a viscosity"},
           {"1.2 mPa.s", "1.2 m2/s", "6:13: fluid.viscosity", "is not a viscosity"},
           {"1.2 mPa.s", "1.2", "6:13: fluid.viscosity", "has no unit"},
           {"1.2 mPa.s", "1.2 mPas", "6:13: fluid.viscosity", "is not a unit"},
           {"\"1.2 mPa.s\"", "0.0012", "6:13: fluid.viscosity", "without a unit"},
           {"\"0.5 um\"", "0.5", "8:6: numerics.dx", "without a unit"},
           {"0.5 um", "0.5 u", "8:6: numerics.dx", "is not a length"},
           {"0.5 um", "0.5 um2", "8:6: numerics.dx", "is not a length"},
           {"0.5 um", "0.5 um um", "8:6: numerics.dx", "is not a length"},
           {"0.5 um", "0.5um^", "8:6: numerics.dx", "is not a unit"},
           {"0.5 um", "0,5 um", "8:6: numerics.dx", "is not a unit"},
           {"0.5 um", "", "8:6: numerics.dx", "does not begin with a number"},
           {"200 s-1", "200 s", "4:14: channel.shear_rate", "is not a rate"},
           {"200 s-1", "200 degrees/s", "4:14: channel.shear_rate", "is not a unit"},
           {"0.05 T", "0.05 A/m", "13:6: magnetic.B0", "is not a magnetic field"},
           {"0.05 T", "0.05 tesla teslas", "13:6: magnetic.B0", "is not a magnetic field"},
           {"steps = 10", "time = \"1 m\"", "15:8: run.time", "is not a time"},
           {"steps = 10", "time = 1", "15:8: run.time", "without a unit"},
           {"steps = 10", "steps = 9\ncheckpoint = \"10 m\"", "16:14: run.checkpoint",
            "is not a time"},
           {"[run]", "[output]\nseries = \"1 um\"\n[run]", "15:10: output.series", "is not a time"},
           {"[run]", "[analysis]\nlayer = \"3 s\"\n[run]", "15:9: analysis.layer",
            "is not a length"},
           {"[run]", "[contact]\nmorse_beta = \"3 um\"\n[run]", "15:14: contact.morse_beta",
            "is not an inverse length"},
           {"[[carrier]]", "[[cell]]\nshear_modulus = \"6 uN\"\n[[carrier]]",
            "10:17: cell.shear_modulus", "is not a tension"},
           {"[[carrier]]", "[[cell]]\nbending_modulus = \"5 N\"\n[[carrier]]",
            "10:19: cell.bending_modulus", "is not an energy"},
           {"[[carrier]]", "[[cell]]\nvolume_modulus = \"249 N\"\n[[carrier]]",
            "10:18: cell.volume_modulus", "is not a pressure"}})
    refused(changed(from, to), std::string("case.toml:") + place + ": ", says);
}

TEST_F(BadInput, NumbersThatAreNoneOrWithoutEnd) {
  for (const auto& [from, to, place, says] : std::vector<Malformed>{
           {"0.5 um", "nan um", "8:6: numerics.dx", "does not begin with a number"},
           {"0.5 um", "1e400 um", "8:6: numerics.dx", "does not begin with a number"},
           {"0.5 um", "1e-400 um", "8:6: numerics.dx", "does not begin with a number"},
           {"0.5 um", "1e308 Gm", "8:6: numerics.dx", "is out of range"},
           {"0.05 T", "-inf T", "13:6: magnetic.B0", "does not begin with a number"},
           {"0.5 um\"", "0.5 um\"\ntau = nan", "9:7: numerics.tau", "is out of range"},
           {"0.5 um\"", "0.5 um\"\ntau = inf", "9:7: numerics.tau", "is out of range"},
           {"0.5 um\"", "0.5 um\"\ncell_reynolds = nan", "9:17: numerics.cell_reynolds",
            "is out of range"},
           {"0.5 um\"", "0.5 um\"\ncell_reynolds = inf", "9:17: numerics.cell_reynolds",
            "is out of range"},
           {"count = 3", "susceptibility = inf", "10:18: carrier.susceptibility",
            "is out of range"},
           {"count = 3", "magnetic_fraction = nan", "10:21: carrier.magnetic_fraction",
            "is out of range"},
           {"B0 =", "axis = [nan, 0, 1]\nB0 =", "13:8: magnetic.axis", "has no direction"},
           {"[[carrier]]", "[[cell]]\nhematocrit = nan\n[[carrier]]", "10:14: cell.hematocrit",
            "is out of range"},
           {"[run]", "[contact]\nepsilon = inf\n[run]", "15:11: contact.epsilon",
            "is out of range"}})
    refused(changed(from, to), std::string("case.toml:") + place + ": ", says);
}

TEST_F(BadInput, CountsBelowZeroOrBeyondCounting) {
  for (const auto& [from, to, place, says] : std::vector<Malformed>{
           {"count = 3", "count = 3000000000", "10:9: carrier.count", "is out of range"},
           {"count = 3", "kind = \"worm\"\nbeads = -8", "11:9: carrier.beads", "is out of range"},
           {"count = 3", "kind = \"worm\"\nbeads = 1", "11:9: carrier.beads", "is out of range"},
           {"steps = 10", "steps = -10", "15:9: run.steps", "is out of range"},
           {"steps = 10", "steps = 9223372036854775807", "15:9: run.steps", "is out of range"},
           {"steps = 10", "steps = 9223372036854775808", "15:", "TOML"},
           {"steps = 10", "steps = 2147483648", "15:9: run.steps", "at most 2147483647"},
           {"steps = 10", "time = \"1e30 s\"", "15:8: run.time", "at most 2147483647"},
           {"steps = 10", "time = \"-1 s\"", "15:8: run.time", "is out of range"},
           {"title = \"case\"", "seed = -1", "1:8: seed", "is out of range"},
           {"[[carrier]]", "[[cell]]\ncount = -1\n[[carrier]]", "10:9: cell.count",
            "is out of range"},
           {"[[carrier]]", "[[cell]]\nvertices = -162\n[[carrier]]", "10:12: cell.vertices",
            "is out of range"},
           {"[[carrier]]", "[[cell]]\nvertices = 100001\n[[carrier]]", "10:12: cell.vertices",
            "is out of range"},
           {"[\"8 um\", \"8 um\", \"8 um\"]", "[\"8 um\", \"-8 um\", \"8 um\"]",
            "3:8: channel.size", "is out of range"},
           {"[\"8 um\", \"8 um\", \"8 um\"]", "[\"1 mm\", \"1 mm\", \"1 mm\"]", "3:8: channel.size",
            "a box of 8e+09 nodes"},
           {"[\"8 um\", \"8 um\", \"8 um\"]", "[\"8 um\", \"8 um\", \"1.5 um\"]",
            "3:8: channel.size", "at least 4"}})
    refused(changed(from, to), std::string("case.toml:") + place, says);
}

TEST_F(BadInput, ValuesOfAnotherType) {
  for (const auto& [from, to, place, says] : std::vector<Malformed>{
           {"count = 3", "count = true", "10:9: carrier.count", "true or false is not"},
           {"count = 3", "count = [3]", "10:9: carrier.count", "a list is not"},
           {"count = 3", "feedback = \"no\"", "10:12: carrier.feedback", "a string is not"},
           {"count = 3", "feedback = 0", "10:12: carrier.feedback", "a whole number is not"},
           {"\"125 nm\"", "[\"125 nm\"]", "11:10: carrier.radius", "a list without a unit"},
           {"\"125 nm\"", "{ nm = 125 }", "11:10: carrier.radius", "a table without a unit"},
           {"\"0.5 um\"", "2020-01-01", "8:6: numerics.dx", "a date or time without a unit"},
           {"\"200 s-1\"", "true", "4:14: channel.shear_rate", "true or false without a unit"},
           {"steps = 10", "steps = 10.0", "15:9: run.steps", "a number is not"},
           {"steps = 10", "steps = \"10\"", "15:9: run.steps", "a string is not"},
           {"steps = 10", "steps = 10\ncheckpoint = false", "16:14: run.checkpoint",
            "true or false without a unit"},
           {"\"case\"", "[\"case\"]", "1:9: title", "a list is not"},
           {"title = \"case\"", "seed = \"one\"", "1:8: seed", "a string is not"},
           {"title = \"case\"", "fluid = 3\ntitle = \"case\"", "6:1: syntax", "redefine"},
           {"[run]\nsteps = 10", "[[run]]\nsteps = 10", "14:1: run", "a [run] table is expected"},
           {"[[carrier]]\n", "carrier.0 = 3\n[[carrier]]\n", "9:1: numerics.carrier",
            "is not a key"},
           {"B0 = \"0.05 T\"", "axis = [0, 1]", "13:8: magnetic.axis", "three numbers"},
           {"B0 = \"0.05 T\"", "dipoles = \"none\"", "13:11: magnetic.dipoles", "true or false"},
           {"0.5 um\"", "0.5 um\"\nscheme = 3", "9:10: numerics.scheme", "a whole number is not"},
           {"200 s-1\"", "200 s-1\"\nboundary = true", "5:12: channel.boundary",
            "true or false is not"}})
    refused(changed(from, to), std::string("case.toml:") + place + ": ", says);
}

TEST_F(BadInput, KeysGivenTwice) {
  for (const auto& [from, to, place, says] : std::vector<Malformed>{
           {"dx =", "dx = \"1 um\"\ndx =", "9:", "redefine existing string 'dx'"},
           {"[run]", "[fluid]\ndensity = \"1000 kg/m3\"\n[run]", "14:1: syntax",
            "redefine existing table 'fluid'"},
           {"[magnetic]", "[magnetic]\n[[magnetic.source]]\n[magnetic.source]", "14:", "redefine"},
           {"steps = 10", "steps = 10\nsteps = 10", "16:", "redefine"},
           {"title =", "channel.axis = \"x\"\ntitle =", "3:1: syntax", "redefine"}})
    refused(changed(from, to), std::string("case.toml:") + place, says);
}

TEST_F(BadInput, KeysNearlyRight) {
  for (const auto& [from, to, place, says] : std::vector<Malformed>{
           {"viscosity", "vicosity", "6:12: fluid.vicosity", "did you mean viscosity?"},
           {"shear_rate", "shearrate", "4:13: channel.shearrate", "did you mean shear_rate?"},
           {"size", "sise", "3:8: channel.sise", "did you mean size?"},
           {"dx", "dX", "8:6: numerics.dX", "did you mean dx?"},
           {"steps", "Steps", "15:9: run.Steps", "did you mean steps?"},
           {"count", "number", "10:10: carrier.number", "is not a key"},
           {"B0", "b0", "13:6: magnetic.b0", "did you mean B0?"},
           {"[fluid]", "[fluids]", "5:1: fluids", "did you mean fluid?"},
           {"[[carrier]]", "[[carriers]]", "9:1: carriers", "did you mean carrier?"},
           {"title", "titel", "1:9: titel", "did you mean title?"},
           {"title", "\"ti\\ntle\"", "1:13: ti?tle", "did you mean title?"},
           {"title", "\"\"", "1:6: \"\"", "is not a key"}})
    refused(changed(from, to), std::string("case.toml:") + place, says);
}

TEST_F(BadInput, FilesThatAreNoCase) {
  const auto text = [](const char* bytes, std::size_t n) { return std::string(bytes, n); };
  refused("", "case.toml:1:1: channel.size:", "is missing");
  refused("\n\n# nothing\n", "case.toml:1:1: channel.size:", "is missing");
  refused("a case of blood", "case.toml:1:", "TOML");
  refused(text("\x7f"
               "ELF\2\1\1\0\0\0",
               10),
          "case.toml:1:1: syntax:", "TOML");
  refused(text("\0\0\0\0", 4), "case.toml:1:1: syntax:", "TOML");
  refused(good + text("\xff\xfe\x00", 3), "case.toml:15:", "TOML");
  refused(text("\xff\xfe[\0f\0", 6), "case.toml:1:", "TOML");
  refused(changed("\"case\"", "\"case"), "case.toml:1:", "TOML");
  refused(changed("\"case\"", "\"a\\qb\""), "case.toml:1:", "TOML");
  refused(changed("\"case\"", "\"a\\nb\""), "case.toml:1:9: title:", "one line");
  refused(changed("\"case\"", '"' + std::string(201, 'a') + '"'),
          "case.toml:1:9: title:", "200 characters");
  refused(good + "a = " + std::string(400, '[') + std::string(400, ']'), "case.toml:16:", "TOML");
  std::filesystem::remove(directory_ / "case.toml");
  std::filesystem::create_directories(directory_ / "case.toml");
  expect_refusal(run_file("case.toml"), "file: cannot be read", "a directory");
}

TEST_F(BadInput, NamesOfFilesThatCannotBe) {
  const std::string longest(300, 'a');
  for (const std::string& name :
       {longest, std::string("."), std::string("a/\\n/b.csv"), std::string("")})
    refused(field_with("field = \"table\"\nfile = \"" + name + "\"\n"),
            "case.toml:14:8: magnetic.file:", "cannot be read");
  refused(channel_with("boundary = \"voxels\"\nmean_velocity = \"1 mm/s\"\ngeometry = \"" +
                       longest + "\"\n"),
          "case.toml:6:12: channel.geometry:", "cannot be read");
  refused(changed("[[carrier]]", "[[cell]]\nmesh = \"" + longest + "\"\n[[carrier]]"),
          "case.toml:10:8: cell.mesh:", "cannot be read");
  refused(
      changed("[[carrier]]", "[[cell]]\nplacement = { file = \"" + longest + "\" }\n[[carrier]]"),
      "case.toml:10:13: cell.placement:", "cannot be read");
}

TEST_F(BadInput, MeshesThatAreNotClosedOrNotThere) {
  const std::string points = "1 1 1\n3 1 1\n1 3 1\n1 1 3\n";
  const std::string faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const auto mesh = [&](const std::string& name, const std::string& bytes,
                        const std::string& says) {
    std::ofstream(directory_ / name, std::ios::binary) << bytes;
    refused(changed("[[carrier]]", "[[cell]]\ncount = 1\nmesh = \"" + name + "\"\n[[carrier]]"),
            "case.toml:11:8: cell.mesh: " + name + ": ", says);
  };
  mesh("a.off", "OFF\n4 3 0\n" + points + faces.substr(8), "3 open edges");
  mesh("a.off", "OFF\n4 4 0\n" + points + "3 0 1 2\n" + faces.substr(8),
       "turned against each other");
  mesh("a.off", "OFF\n4 4 0\n" + points + "3 0 2 4\n" + faces.substr(8), "names point 4");
  mesh("a.off", "OFF\n4 4 0\n1 1 nan\n" + points.substr(6) + faces, "finite");
  mesh("a.off", "OFF\n4 4 0\n" + points + "3 0 2\n" + faces.substr(8), "line 7");
  mesh("a.off", "OFF\n4 4 0\n" + points + faces.substr(0, 16), "the file ends before");
  mesh("a.off", "OFF\n2000000000 4 0\n" + points + faces, "counts 2000000000 points");
  mesh("a.off", "OFF\n4 4 0\n1 1 1\n2 1 1\n3 1 1\n4 1 1\n" + faces, "accepted");
  mesh("a.off", "", "the file is empty");
  mesh("a.off",
       std::string("\x7f"
                   "ELF\0\1",
                   6),
       "where 'OFF' must be");
  mesh("a.stl",
       std::string("\x7f"
                   "ELF\0\1",
                   6),
       "has 6 bytes");
  mesh("a.stl", std::string(84, '\0'), "no triangles");
  mesh("a.ply", "ply\nformat ascii 1.0\nend_header\n", "no triangles");
  mesh("a.obj", "v 0 0 0\n", "accepted are surfaces in .stl, .off and .ply files");
}

TEST_F(BadInput, TablesWithHoles) {
  const std::string header = "x_m,y_m,z_m,Bx_T,By_T,Bz_T\n";
  std::vector<std::string> rows;
  for (int k = 0; k < 80; ++k)
    rows.push_back(std::to_string(k % 4) + "e-5," + std::to_string(k / 4 % 4) + "e-5," +
                   std::to_string(k / 16) + "e-5,0,0,0.01\n");
  const auto table = [&](const std::string& bytes, const std::string& says) {
    std::ofstream(directory_ / "B.csv", std::ios::binary) << bytes;
    refused(field_with("field = \"table\"\nfile = \"B.csv\"\n"),
            "case.toml:14:8: magnetic.file: B.csv: ", says);
  };
  const auto with = [&](std::size_t row, const std::string& text) {
    std::string all = header;
    for (std::size_t k = 0; k < rows.size(); ++k) all += k == row ? text : rows[k];
    return all;
  };
  table(with(20, ""), "79 rows");
  table(with(79, ""), "79 rows");
  table(with(20, rows[20] + rows[20]), "81 rows");
  table(with(20, "9e-5,1e-5,1e-5,0,0,0.01\n"), "line 22: x is");
  table(with(20, "0e-5,1e-5,1e-5,0,0,nan\n"), "line 22: 'nan' is not finite");
  table(with(20, "0e-5,1e-5,1e-5,0,0,O\n"), "line 22: 'O' is not a number");
  table(header, "the file ends before the first row");
  table("", "the file is empty");
  table("x,y,z,Bx,By,Bz\n" + rows[0], "the header is");
  table(std::string("\x7f"
                    "ELF\0\1\n",
                    7),
        "the header is");
}

TEST_F(BadInput, PackedStatesOfAnotherCase) {
  const std::string cell = "[[cell]]\nvertices = 200\ncount = 1\nplacement = \"grow\"\n[[carrier]]";
  const std::string from = "{ file = \"packed/packed.data\" }";
  std::ofstream(directory_ / "case.toml") << changed("[[carrier]]", cell);
  const std::string command =
      "cd " + directory_.string() + " && " HEMOMAG_BINARY " pack case.toml --out packed >/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto with = [&](const std::string& was, const std::string& is) {
    std::string text = changed("[[carrier]]", cell);
    text.replace(text.find("\"grow\""), 6, from);
    return text.replace(text.find(was), was.size(), is);
  };
  const std::string at = "case.toml:12:13: cell.placement: packed/packed.data: ";
  refused(with("title = \"case\"", "seed = 2"), at, "packed with seed 1, the case has 2");
  refused(with("count = 1", "count = 2"), at, "the case has 2 cells");
  refused(with("vertices = 200", "vertices = 201"), at, "201 vertices");
  refused(with("\"8 um\", \"8 um\", \"8 um\"", "\"8 um\", \"8 um\", \"9 um\""), at, "along z");
  const auto packed = directory_ / "packed" / "packed.data";
  const std::string whole = content(packed);
  const auto damaged = [&](const std::string& bytes, const std::string& says) {
    std::ofstream(packed, std::ios::binary) << bytes;
    refused(with("title = \"case\"", "title = \"" + says + "\""), at, says);
  };
  damaged(whole.substr(0, whole.find("\nBonds")), "the file ends before");
  damaged(whole.substr(0, whole.find(" bonds")), "the file ends before");
  std::string counts = whole;
  const auto types = counts.find("bond types");
  const auto line = counts.rfind('\n', types) + 1;
  damaged(counts.replace(line, types - line, "2147483647 "), "the file ends before 2147483647");
  damaged("", "the file is empty");
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
  EXPECT_TRUE(std::filesystem::exists(directory_ / "result" / "inspection" / "cells_00000.vtkhdf"));
}

TEST_F(BadInput, AChannelOfPlasmaAloneIsGood) {
  std::string text = good;
  text.erase(text.find("[[carrier]]"), text.find("[run]") - text.find("[[carrier]]"));
  const Outcome outcome = run(text);
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_TRUE(std::filesystem::exists(directory_ / "result" / "summary.json"));
}

TEST_F(BadInput, TheGoodFileIsGood) {
  const Outcome outcome = run(good);
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_TRUE(std::filesystem::exists(directory_ / "result" / "summary.json"));
}

}  // namespace
