// margination.csv of examples/one_way_drift.toml follows the closed form at two fields.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace {

/// Largest distance of the run's probability from 1 - exp(-t/T_e).
double largest_error(const char* field, const char* time, double T_e) {
  const auto out =
      std::filesystem::temp_directory_path() / ("hemomag_drift_" + std::to_string(getpid()));
  const std::string command = "mpirun -np 2 " HEMOMAG_BINARY " run " HEMOMAG_SOURCE_DIR
                              "/examples/one_way_drift.toml --out " +
                              out.string() + " --set 'magnetic.B0=" + field +
                              "' --set 'run.time=" + time + "' >/dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream csv(out / "margination.csv");
  std::string header;
  std::getline(csv, header);
  EXPECT_EQ(header, "time_s,in_layer,probability");
  double worst = 0, t = 0, last = 0;
  int rows = 0;
  for (std::string row; std::getline(csv, row); ++rows) {
    double count = 0, probability = 0;
    EXPECT_EQ(std::sscanf(row.c_str(), "%lf,%lf,%lf", &t, &count, &probability), 3);
    worst = std::max(worst, std::fabs(probability - (1 - std::exp(-t / T_e))));
    last = probability;
  }
  EXPECT_GT(rows, 20);
  std::printf("B0 %s, T_e %.1f ms: largest difference %.4f over %d rows, tolerance 0.03; at the "
              "end (%.3f s) %.4f expected %.4f\n",
              field, T_e * 1e3, worst, rows, t, last, 1 - std::exp(-t / T_e));
  std::filesystem::remove_all(out);
  return worst;
}

// Sampling noise of 8,000 particles 0.01, wall gap of the starting heights 0.01.
constexpr double tolerance = 0.03;

TEST(OneWayDrift, FollowsTheClosedFormAtFiftyMillitesla) {
  EXPECT_LT(largest_error("0.05 T", "0.6 s", 0.4168), tolerance);
}
TEST(OneWayDrift, FollowsTheClosedFormAtHundredMillitesla) {
  EXPECT_LT(largest_error("0.1 T", "0.25 s", 0.1042), tolerance);
}

}  // namespace
