// What a user reads off a run of 2,000 steps is the same on 1, 2, 4 and 8 ranks.
#include <cmath>
#include <cstdio>
#include <string>

#include <nlohmann/json.hpp>

#include "support/run_directory.hpp"

namespace hemomag::test {
namespace {

constexpr const char* text = R"(title = "on any ranks"
[channel]
size = ["9 um", "14 um", "9 um"]
shear_rate = "200 s-1"
[fluid]
viscosity = "1.2 mPa.s"
[numerics]
dx = "0.5 um"
cell_reynolds = 0.5
[[cell]]
count = 2
vertices = 642
[[carrier]]
count = 40
radius = "125 nm"
[magnetic]
field = "gradient"
B0 = "0.1 T"
[run]
steps = 2000
[output]
fields = "never"
series = "0.5 ms"
cells = "0.5 ms"
profiles = "0.5 ms"
)";

using RankCounts = RunDirectory;

/// The largest relative difference of the numbers of two texts that are the same otherwise.
double difference(const std::string& a, const std::string& b) {
  std::istringstream one(a), other(b);
  double worst = 0;
  std::string s, t;
  while (std::getline(one, s, ',') && std::getline(other, t, ',')) {
    char* end = nullptr;
    const double x = std::strtod(s.c_str(), &end), y = std::strtod(t.c_str(), nullptr);
    if (end == s.c_str())
      EXPECT_EQ(s, t);
    else
      worst = std::max(worst, std::fabs(x - y) / std::max({1.0, std::fabs(x), std::fabs(y)}));
  }
  EXPECT_EQ(one.eof(), other.eof());
  return worst;
}

TEST_F(RankCounts, TheObservablesOf2000StepsAgree) {
  write_case(text);
  for (const int n : {1, 2, 4, 8}) {
    const Outcome outcome = run(n, "on" + std::to_string(n));
    ASSERT_EQ(outcome.code, 0) << outcome.said;
  }
  const auto one = nlohmann::json::parse(content(directory_ / "on1/summary.json"));
  EXPECT_GT(one["probability_end"], 0.1) << "carriers have moved";
  EXPECT_EQ(one["cells_end"], 2);
  constexpr double round_off_grown = 1e-8;  // over 2,000 steps of cells that collide
  for (const int n : {2, 4, 8}) {
    const auto there = directory_ / ("on" + std::to_string(n));
    const auto other = nlohmann::json::parse(content(there / "summary.json"));
    double worst = 0;
    for (const char* name : {"probability_end", "probability_mean", "cells_end", "carriers_end",
                             "carriers_inside_max", "mach_max", "displacement_max_nodes",
                             "stretch_max", "area_drift_max", "volume_drift_max"}) {
      const double a = one[name], b = other[name];
      worst = std::max(worst, std::fabs(a - b));
      EXPECT_NEAR(a, b, round_off_grown) << name << " on " << n << " ranks";
    }
    for (const char* name : {"hematocrit", "layer_um", "relative_viscosity"}) {
      const double a = one["profiles"][name], b = other["profiles"][name];
      worst = std::max(worst, std::fabs(a - b));
      EXPECT_NEAR(a, b, round_off_grown) << name << " on " << n << " ranks";
    }
    double rows = 0;
    for (const char* name : {"margination.csv", "cells.csv", "profiles.csv", "layer.csv"})
      rows = std::max(rows, difference(content(directory_ / "on1" / name), content(there / name)));
    EXPECT_LT(rows, 1e-6) << "written with nine digits";
    std::printf("%d ranks against 1: summary %.1e, rows of the CSV files %.1e\n", n, worst, rows);
  }
}

}  // namespace
}  // namespace hemomag::test
