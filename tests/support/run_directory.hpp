#pragma once
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hemomag::test {

struct Outcome {
  int code;
  std::string said;  ///< on both outputs
};

inline Outcome shell(const std::string& command) {
  std::FILE* pipe = popen(("(" + command + ") 2>&1").c_str(), "r");
  std::string said;
  std::array<char, 512> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe)) said += buffer.data();
  return {WEXITSTATUS(pclose(pipe)), said};
}

inline std::string content(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// A directory of its own for each test, and the program run in it.
class RunDirectory : public testing::Test {
protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name =
        std::string(test->test_suite_name()) + "_" + test->name() + "_" + std::to_string(getpid());
    for (char& c : name)
      if (c == '/') c = '_';
    directory_ = std::filesystem::temp_directory_path() / ("hemomag_" + name);
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  void write_case(const std::string& text) const {
    std::ofstream(directory_ / "case.toml") << text;
  }
  /// `hemomag run case.toml --out OUT ...` on some ranks.
  std::string command(int ranks, const std::string& out, const std::string& options = "") const {
    const std::string parallel = ranks > 1 ? "mpirun -np " + std::to_string(ranks) + " " : "";
    return "cd " + directory_.string() + " && " + parallel +
           HEMOMAG_BINARY " run case.toml --out " + out + " " + options;
  }
  Outcome run(int ranks, const std::string& out, const std::string& options = "") const {
    return shell(command(ranks, out, options));
  }
  void copy(const std::string& from, const std::string& to) const {
    std::filesystem::copy(directory_ / from, directory_ / to,
                          std::filesystem::copy_options::recursive);
  }

  /// Whether two finished runs are the same to the last bit: the state at the end with all that
  /// fixes remember, every row, every snapshot.
  void expect_same(const std::string& a, const std::string& b) const {
    std::set<std::string> names{"checkpoint/atoms.restart", "checkpoint/fluid.h5"};
    for (const auto& run : {a, b})
      for (const char* kind : {".", "fields"})
        if (std::filesystem::exists(directory_ / run / kind))
          for (const auto& entry : std::filesystem::directory_iterator(directory_ / run / kind))
            if (const auto e = entry.path().extension();
                e == ".csv" || e == ".vtkhdf" || e == ".series")
              names.insert(std::string(kind) + "/" + entry.path().filename().string());
    for (const auto& name : names) {
      const std::string one = content(directory_ / a / name),
                        other = content(directory_ / b / name);
      EXPECT_FALSE(one.empty()) << a << "/" << name << " is missing";
      EXPECT_TRUE(one == other) << name << " differs between " << a << " and " << b;
    }
    EXPECT_GE(names.size(), 3u);
  }

  std::filesystem::path directory_;
};

}  // namespace hemomag::test
