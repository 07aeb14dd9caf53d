// fix hemo/watch and the fluid end a run that is not sound, and say where and why.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace {

const std::vector<std::string> channel = {"units lj",
                                          "atom_style molecular",
                                          "newton on",
                                          "boundary p p f",
                                          "region b block 0 12 0 12 0 12",
                                          "create_box 1 b bond/types 1 extra/bond/per/atom 1",
                                          "mass * 1",
                                          "neighbor 1.0 bin",
                                          "neigh_modify every 1 delay 0 check yes",
                                          "timestep 1.0"};

/// What a script says at its end; empty when it runs through.
std::string outcome(const std::vector<std::string>& script) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("hemomag_watch_" + std::to_string(getpid()) + ".in");
  {
    std::ofstream out(file);
    for (const auto& line : channel) out << line << "\n";
    for (const auto& line : script) out << line << "\n";
  }
  const std::string command =
      "mpirun -np 2 " HEMOMAG_BINARY " lmp -log none -in " + file.string() + " 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string said;
  std::array<char, 512> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe)) said += buffer.data();
  const int status = pclose(pipe);
  std::filesystem::remove(file);
  return status == 0 ? std::string() : said;
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const auto& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << word << " is not in: " << text;
}

TEST(Watch, EndsARunWhoseFluidIsTooFast) {
  expect_words(
      outcome({"pair_style zero 1", "pair_coeff * *",
               "fix fluid all hemo/fluid tau 1 plates z lower 0 0 0 upper 0 0.25 0 initial linear",
               "fix watch all hemo/watch 10 mach_max 0.3", "run 100"}),
      {"fix hemo/watch", "step 0", "Mach number is 0.41", "limit is 0.3"});
}

TEST(Watch, EndsARunWhoseCarriersLeft) {
  // delete_atoms stands for a carrier that vanished without a word.
  expect_words(
      outcome({"create_atoms 1 single 3 3 3", "create_atoms 1 single 6 6 6", "pair_style zero 1",
               "pair_coeff * *", "fix drag all hemo/drag radius 1 0.25",
               "fix fluid all hemo/fluid tau 1 plates z lower 0 0 0 upper 0 0 0",
               "fix watch all hemo/watch 10 carriers all", "run 10", "group gone id 2",
               "delete_atoms group gone", "run 10"}),
      {"fix hemo/watch", "1 carriers", "began with 2"});
}

/// What one rank alone has met ends both, with the state to look at. @return what was said
std::string inspected(const std::vector<std::string>& before_fluid) {
  const auto directory =
      std::filesystem::temp_directory_path() / ("hemomag_inspection_" + std::to_string(getpid()));
  auto script = before_fluid;
  script.insert(script.end(), {"fix fluid all hemo/fluid tau 1 plates z lower 0 0 0 upper 0 0 0",
                               "fix watch all hemo/watch 1000 carriers all inspection " +
                                   directory.string() + " 0.5 1e-8",
                               "run 2000"});
  const std::string said = outcome(script);
  EXPECT_TRUE(std::filesystem::exists(directory / "fluid_00000.vtkhdf")) << said;
  EXPECT_FALSE(std::filesystem::exists(directory / "fluid_00001.vtkhdf"));
  std::filesystem::remove_all(directory);
  return said;
}

TEST(Watch, EndsARunWhoseSpringBreaks) {
  const auto said =
      inspected({"create_atoms 1 single 3 3 6", "create_atoms 1 single 4 3 6", "pair_style zero 1",
                 "pair_coeff * *", "bond_style hemo/wlc", "bond_coeff 1 1 0.5 2 1e-7 2 0 0",
                 "create_bonds single/bond 1 1 2", "group right id 2", "fix advect all hemo/advect",
                 "fix pull right addforce 0.5 0 0"});
  expect_words(said, {"fix hemo/watch: step", "rank 1: bond_style hemo/wlc: the edge between atoms",
                      "its limit is 2"});
}

TEST(Watch, EndsARunWhoseCarrierPassesAPlate) {
  const auto said =
      inspected({"create_atoms 1 single 3 3 3", "create_atoms 1 single 3 9 10", "pair_style zero 1",
                 "pair_coeff * *", "group high id 2", "fix drag all hemo/drag radius 1 0.25",
                 "fix pull high addforce 0 0 0.2"});
  expect_words(said, {"fix hemo/watch: step", "rank 1: carrier 2 at 3", "is beyond a plate"});
}

TEST(Watch, EndsARunWhoseCarrierJumpsAlongAPeriodicAxis) {
  const auto said = inspected({"create_atoms 1 single 3 3 3", "create_atoms 1 single 3 9 9",
                               "pair_style zero 1", "pair_coeff * *", "group high id 2",
                               "fix drag all hemo/drag radius 1 0.25 feedback no",
                               "fix pull high addforce 0 9 0"});
  expect_words(said, {"fix hemo/watch: step 1, rank", "carrier 2 at 3", "nodes in a step",
                      "the limit is 0.5"});
}

TEST(Watch, KeepsItsReasonWhenTheInspectionCannotBeWritten) {
  const auto said =
      outcome({"create_atoms 1 single 3 3 3", "create_atoms 1 single 3 9 10", "pair_style zero 1",
               "pair_coeff * *", "group high id 2", "fix drag all hemo/drag radius 1 0.25",
               "fix pull high addforce 0 0 0.2",
               "fix fluid all hemo/fluid tau 1 plates z lower 0 0 0 upper "
               "0 0 0",
               "fix watch all hemo/watch 1000 carriers all inspection /dev/null/there 0.5 1e-8",
               "run 2000"});
  expect_words(said, {"hemomag: the run broke off: ERROR: fix hemo/watch: step",
                      "is beyond a plate", "hemomag: its state could not be kept", "/dev/null"});
}

TEST(Watch, PassesASoundRun) {
  EXPECT_EQ(outcome({"create_atoms 1 single 3 3 3", "pair_style zero 1", "pair_coeff * *",
                     "fix drag all hemo/drag radius 1 0.25",
                     "fix fluid all hemo/fluid tau 1 plates z lower 0 0 0 upper 0 0.02 0",
                     "fix watch all hemo/watch 10 carriers all", "run 50"}),
            "");
}

TEST(Fluid, RefusesWhatItCannotDo) {
  const std::vector<std::string> start = {"pair_style zero 1", "pair_coeff * *"};
  const auto with = [&](const std::vector<std::string>& lines) {
    auto script = start;
    script.insert(script.end(), lines.begin(), lines.end());
    return outcome(script);
  };
  expect_words(with({"fix fluid all hemo/fluid tau 0.5"}), {"tau = 0.5", "need tau > 0.5"});
  expect_words(with({"fix fluid all hemo/fluid tua 1"}), {"unknown keyword tua", "accepted: tau"});
  expect_words(with({"fix fluid all hemo/fluid tau 1 scheme mrt"}),
               {"mrt", "accepted: trt, bgk, exponential"});
  expect_words(with({"fix fluid all hemo/fluid tau 1 precision half"}),
               {"half", "accepted: double, single"});
  expect_words(with({"fix fluid all hemo/fluid tau 1 curved smooth"}),
               {"smooth", "accepted: interpolated, halfway"});
  expect_words(with({"fix fluid all hemo/fluid tau 1 plates z lower 0 0 0 upper 0 0 0 tube y 6 6 5",
                     "run 1"}),
               {"plates and a vessel exclude each other"});
  expect_words(with({"fix fluid all hemo/fluid tau 1", "run 1"}),
               {"axis z has no plates and must be periodic"});
  expect_words(with({"fix fluid all hemo/fluid tau 1 kernel box3"}),
               {"box3", "accepted: cosine4, peskin4, roma3, linear2"});
  expect_words(with({"fix fluid all hemo/fluid tau 1 plates z lower 0 0 0 upper 0 0 0",
                     "fix push all addforce 0 0 1", "run 1"}),
               {"must be the last fix that adds forces"});
  expect_words(with({"fix fluid all hemo/fluid tau 1 plates z lower 0 0 0 upper 0 0 0",
                     "timestep 0.5", "run 1"}),
               {"timestep 1.0"});
}

TEST(Drag, RefusesCarriersLargerThanTheKernel) {
  expect_words(
      outcome({"create_atoms 1 single 3 3 3", "pair_style zero 1", "pair_coeff * *",
               "fix drag all hemo/drag radius 1 1.4",
               "fix fluid all hemo/fluid tau 1 plates z lower 0 0 0 upper 0 0 0", "run 1"}),
      {"radius 1.4", "hydrodynamic radius 1.356"});
}

}  // namespace
