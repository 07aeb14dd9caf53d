// Files are written whole, and trouble is reported with path and reason.
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/error.hpp"
#include "io/files.hpp"

namespace {

using namespace hemomag;

class Files : public testing::Test {
protected:
  void SetUp() override { io::make_directory(directory_); }
  void TearDown() override { std::filesystem::remove_all(directory_); }
  static std::string read(const std::string& path) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
  const std::string directory_ =
      (std::filesystem::temp_directory_path() / ("hemomag_files_" + std::to_string(getpid())))
          .string();
};

TEST_F(Files, AreReplacedAsAWhole) {
  const std::string path = directory_ + "/a.txt";
  io::replace_file(path, "one\n");
  io::replace_file(path, "two\n");
  EXPECT_EQ(read(path), "two\n");
  EXPECT_FALSE(std::filesystem::exists(path + ".new"));
}

TEST_F(Files, CsvRowsAreOnDiskAtOnce) {
  io::CsvFile csv(directory_ + "/a.csv", "time_s,in_layer");
  csv.row({0, 18});
  csv.row({0.00102204, 19});
  EXPECT_EQ(read(directory_ + "/a.csv"), "time_s,in_layer\n0,18\n0.00102204,19\n");
}

TEST_F(Files, ASeriesIndexNamesEveryFileWithItsTime) {
  io::SeriesIndex index(directory_ + "/fluid.vtkhdf.series");
  index.add("fluid_00000.vtkhdf", 0);
  index.add("fluid_00001.vtkhdf", 0.25);
  const std::string text = read(directory_ + "/fluid.vtkhdf.series");
  EXPECT_NE(text.find("\"file-series-version\": \"1.0\""), std::string::npos);
  EXPECT_NE(text.find("fluid_00001.vtkhdf"), std::string::npos);
  EXPECT_NE(text.find("0.25"), std::string::npos);
}

TEST_F(Files, TroubleNamesPathAndReason) {
  const std::string nowhere = directory_ + "/absent/a.txt";
  for (const auto& attempt : {std::function<void()>([&] { io::replace_file(nowhere, "x"); }),
                              std::function<void()>([&] { io::CsvFile(nowhere, "x"); })}) {
    try {
      attempt();
      FAIL() << "no error";
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("absent"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("No such file"), std::string::npos) << e.what();
    }
  }
  io::replace_file(directory_ + "/file", "x");
  EXPECT_THROW(io::make_directory(directory_ + "/file/below"), Error);
}

}  // namespace
