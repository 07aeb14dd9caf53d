// What can happen to a run, and that nothing older than its last checkpoint is lost.
#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mount.h>

#include "support/run_directory.hpp"

namespace hemomag::test {
namespace {

const std::string small = R"(title = "small"
[channel]
size = ["8 um", "9 um", "8 um"]
shear_rate = "200 s-1"
[fluid]
viscosity = "1.2 mPa.s"
[numerics]
dx = "0.5 um"
cell_reynolds = 0.25
[[cell]]
count = 1
vertices = 642
[[carrier]]
count = 12
radius = "125 nm"
[magnetic]
field = "gradient"
B0 = "0.05 T"
[analysis]
average_from = "0 s"
[run]
steps = 300
checkpoint = "1 h"
[output]
fields = "0.2 ms"
series = "0.05 ms"
)";

class Faults : public RunDirectory {
protected:
  void SetUp() override {
    RunDirectory::SetUp();
    write_case(small);
  }
  void expect_said(const Outcome& outcome, int code, const std::vector<std::string>& words) {
    EXPECT_EQ(outcome.code, code) << outcome.said;
    for (const auto& word : words)
      EXPECT_NE(outcome.said.find(word), std::string::npos)
          << "'" << word << "' is not in: " << outcome.said;
  }
  /// Start a run and wait until it is under way.
  std::string in_background(const std::string& out, const std::string& options) {
    const std::string rows = (directory_ / out / "margination.csv").string();
    return command(1, out, options) + " & while ! [ -f " + rows + " ] || [ $(wc -l < " + rows +
           ") -lt 4 ]; do sleep 0.02; done; ";
  }
  /// The process of a run, for the shell.
  std::string process(const std::string& out) {
    return "$(sed 's/process \\([0-9]*\\).*/\\1/' " + (directory_ / out / "lock").string() + ")";
  }
  static long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }
  long saved_step(const std::string& checkpoint) {
    const std::string manifest = content(directory_ / checkpoint / "manifest.json");
    const auto at = manifest.find("\"step\": ");
    return at == std::string::npos ? -1 : std::stol(manifest.substr(at + 8));
  }
  void damage(const std::string& file, long byte) {
    std::fstream f(directory_ / file, std::ios::in | std::ios::out | std::ios::binary);
    f.seekg(byte);
    const int was = f.get();
    f.seekp(byte);
    f.put(static_cast<char>(was ^ 1));
  }
};

TEST_F(Faults, CheckpointsLeaveNoTrace) {
  ASSERT_EQ(run(1, "often", "--set run.checkpoint='0 s'").code, 0);
  ASSERT_EQ(run(1, "never", "--set run.checkpoint=never").code, 0);
  const std::string log = content(directory_ / "often/log.lammps");
  EXPECT_GE(saved_step("often/checkpoint.previous"), 100) << log;
  EXPECT_EQ(saved_step("never/checkpoint.previous"), -1);
  expect_same("often", "never");
}

TEST_F(Faults, ARunGoesOnAfterManyStops) {
  ASSERT_EQ(run(1, "whole").code, 0);
  for (const auto& [signal, code] : {std::pair{"TERM", 143}, std::pair{"INT", 130}}) {
    const std::string out = std::string("stopped") + signal;
    const Outcome stopped = shell(in_background(out, "--set run.steps=200000") + "kill -" + signal +
                                  " " + process(out) + "; wait %1");
    expect_said(stopped, code, {"--resume goes on from it"});
    EXPECT_GT(saved_step(out + "/checkpoint"), 0);
    // A run that has gone beyond the end of the undisturbed one cannot be compared with it.
    if (saved_step(out + "/checkpoint") >= 300) continue;
    expect_said(run(1, out, "--resume"), 0, {"going on from step"});
    expect_same("whole", out);
  }
}

TEST_F(Faults, SavesAndGoesOnWhenAsked) {
  const Outcome asked =
      shell(in_background("asked", "--set run.checkpoint=never --set run.steps=1000") +
            "kill -USR1 " + process("asked") + "; wait %1");
  expect_said(asked, 0, {"1000 steps"});
  EXPECT_EQ(saved_step("asked/checkpoint"), 1000);
  EXPECT_GT(saved_step("asked/checkpoint.previous"), 0);
}

TEST_F(Faults, ADamagedCheckpointIsRefusedAndTheOneBeforeItUsed) {
  ASSERT_EQ(run(1, "whole").code, 0);
  const long before = saved_step("whole/checkpoint.previous");
  ASSERT_GT(before, 0);
  const auto after_damage = [&](const char* file, const char* says, auto harm) {
    std::filesystem::remove_all(directory_ / "run");
    copy("whole", "run");
    harm("run/checkpoint/" + std::string(file));
    expect_said(run(1, "run", "--resume"), 0,
                {"not used: run/checkpoint", says, "going on from step " + std::to_string(before)});
    expect_same("whole", "run");
  };
  const auto size = [&](const std::string& file) {
    return static_cast<long>(std::filesystem::file_size(directory_ / file));
  };
  const auto flip = [&](const std::string& file) { damage(file, size(file) / 2); };
  const auto cut = [&](const std::string& file) {
    std::filesystem::resize_file(directory_ / file,
                                 static_cast<std::uintmax_t>(size(file) * 2 / 3));
  };
  const auto remove = [&](const std::string& file) { std::filesystem::remove(directory_ / file); };
  after_damage("fluid.h5", "differs from its checksum", flip);
  after_damage("atoms.restart", "differs from its checksum", flip);
  after_damage("fluid.h5", "differs from its checksum", cut);
  after_damage("case.toml", "cannot be read", remove);
  after_damage("manifest.json", "is damaged", flip);
  after_damage("manifest.json", "is damaged", cut);
}

TEST_F(Faults, EveryByteOfAManifestCounts) {
  ASSERT_EQ(run(1, "run", "--set run.steps=100").code, 0);
  std::filesystem::remove_all(directory_ / "run/checkpoint.previous");
  const std::string manifest = content(directory_ / "run/checkpoint/manifest.json");
  for (std::size_t byte = 0; byte < manifest.size(); byte += 61) {
    damage("run/checkpoint/manifest.json", static_cast<long>(byte));
    expect_said(run(1, "run", "--resume"), 2,
                {"not used: run/checkpoint/manifest.json: is damaged"});
    damage("run/checkpoint/manifest.json", static_cast<long>(byte));
  }
  EXPECT_EQ(run(1, "run", "--resume").code, 0);
}

TEST_F(Faults, ResumingNeedsTheSameCase) {
  ASSERT_EQ(run(1, "run", "--set run.steps=100").code, 0);
  expect_said(run(1, "run", "--resume --set run.steps=100 --set magnetic.B0='0.06 T'"), 2,
              {"--set magnetic.B0: the run was started with", "0.05 T", "accepted"});
  expect_said(run(1, "run", "--resume --set seed=2"), 2, {"--set seed:", "accepted"});
  expect_said(run(1, "run", "--resume --set run.steps=50"), 2,
              {"--set run.steps: 50 steps end before the checkpoint, which is of step 100"});
  expect_said(run(1, "elsewhere", "--resume"), 2, {"there is no run directory elsewhere"});
  expect_said(run(1, "run", "--resume --force"), 2, {"accepted: one of them"});
  std::filesystem::create_directories(directory_ / "empty");
  expect_said(run(1, "empty", "--resume"), 2, {"holds no whole checkpoint", "accepted"});
  // A longer run may go on, and its rows with it.
  expect_said(run(1, "run", "--resume --set run.steps=200"), 0, {"going on from step 100"});
  EXPECT_EQ(saved_step("run/checkpoint"), 200);
}

TEST_F(Faults, ResumingNeedsTheFilesOfTheRun) {
  std::string text = small;
  text.replace(text.find("count = 1\n"), 10, "count = 1\nplacement = \"compress\"\n");
  write_case(text);
  const Outcome packing =
      shell("cd " + directory_.string() + " && " HEMOMAG_BINARY " pack case.toml --out packed");
  ASSERT_EQ(packing.code, 0) << packing.said;
  text.replace(text.find("\"compress\""), 10, "{ file = \"packed/packed.data\" }");
  write_case(text);
  ASSERT_EQ(run(1, "run", "--set run.steps=100").code, 0);
  std::string other = content(directory_ / "packed/packed.data");
  other[other.rfind('1')] = '2';
  std::ofstream(directory_ / "packed/packed.data") << other;
  expect_said(run(1, "run", "--resume"), 2,
              {"case.toml:12:13: cell.placement:", "packed/packed.data differs from the run's copy",
               "accepted with --resume: the file the run was started with"});

  text = small;
  text.replace(text.find("[analysis]\n"), 11,
               "[analysis]\nlayer = \"measured\"\nlayer_run = \"0.1 ms\"\n");
  write_case(text);
  ASSERT_EQ(run(1, "run", "--force --set run.steps=100").code, 0);
  std::filesystem::remove(directory_ / "run/layer/summary.json");
  expect_said(run(1, "run", "--resume"), 2, {"run/layer/summary.json: has no measured layer"});
}

TEST_F(Faults, ALongerRunMayMoveTheDefaultOfItsAverage) {
  std::string text = small;
  text.replace(text.find("average_from = \"0 s\"\n"), 21, "");
  text.replace(text.find("steps = 300"), 11, "time = \"0.3 ms\"");
  write_case(text);
  ASSERT_EQ(run(1, "run").code, 0);
  expect_said(run(1, "run", "--resume --set run.time='0.6 s'"), 2,
              {"analysis.average_from: is another time", "accepted: \"0 s\""});
  const std::string given = " --set analysis.average_from=";
  expect_said(run(1, "run", "--resume --set run.time='0.4 ms'" + given + "'0.1 ms'"), 2,
              {"--set analysis.average_from", "accepted: \"0 s\""});
  EXPECT_EQ(run(1, "run", "--resume --set run.time='0.4 ms'" + given + "'0 s'").code, 0);
}

TEST_F(Faults, OutputThatWasOffReplacesNothing) {
  ASSERT_EQ(run(1, "run", "--set run.steps=100").code, 0);
  const std::string never = " --set output.fields=never --set output.series=never";
  ASSERT_EQ(run(1, "run", "--resume --set run.steps=200" + never).code, 0);
  const std::string rows = content(directory_ / "run/cells.csv");
  const std::string again = "--resume --set run.steps=300";
  expect_said(run(1, "run", again), 2, {"output.fields: was \"never\"", "run/fields", "accepted"});
  expect_said(run(1, "run", again + " --set output.fields=never"), 2,
              {"output.series: was \"never\"", "run/margination.csv", "accepted"});
  EXPECT_EQ(content(directory_ / "run/cells.csv"), rows);
  EXPECT_EQ(run(1, "run", again + never).code, 0);
}

TEST_F(Faults, OnlyARunIsReplaced) {
  std::filesystem::create_directories(directory_ / "mine");
  std::ofstream(directory_ / "mine/thesis.txt") << "years of work";
  expect_said(run(1, "mine", "--force"), 2, {"--out mine: holds other things", "accepted"});
  expect_said(run(1, ".", "--force"), 2, {"--out .: holds other things", "accepted"});
  expect_said(run(1, "case.toml", "--force"), 2, {"--out case.toml: is no directory", "accepted"});
  EXPECT_EQ(content(directory_ / "mine/thesis.txt"), "years of work");
  ASSERT_EQ(run(1, "run", "--set run.steps=10").code, 0);
  std::filesystem::copy_file(directory_ / "case.toml", directory_ / "run/own.toml");
  expect_said(shell("cd " + directory_.string() +
                    " && " HEMOMAG_BINARY " run run/own.toml --out run --force"),
              2, {"holds run/own.toml of the case"});
  std::filesystem::remove(directory_ / "run/own.toml");
  // The run's own copy of its case is that of a run to be repeated.
  EXPECT_EQ(shell("cd " + directory_.string() +
                  " && " HEMOMAG_BINARY " run run/case.toml --out run --force")
                .code,
            0);
}

TEST_F(Faults, ARunThatWasSlowerToStartReplacesNothing) {
  std::string text = small;
  text.replace(text.find("count = 1\n"), 10, "count = 4\nplacement = \"compress\"\n");
  std::ofstream(directory_ / "slow.toml") << text;
  const Outcome both = shell(
      "cd " + directory_.string() + "; " HEMOMAG_BINARY " run slow.toml --out run & sleep 0.3; (" +
      command(1, "run", "--set run.steps=10") + "); echo quick $?; wait %1; echo slow $?");
  expect_said(both, 0, {"quick 0", "slow 2", "exists already"});
  EXPECT_EQ(content(directory_ / "run/case.toml").find("compress"), std::string::npos);
}

TEST_F(Faults, AStopWhileTheLayerIsMeasuredLosesNothing) {
  std::string text = small;
  text.replace(text.find("average_from = \"0 s\"\n"), 21,
               "layer = \"measured\"\nlayer_run = \"30 ms\"\n");
  write_case(text);
  ASSERT_EQ(run(1, "whole").code, 0);
  const std::string saved = (directory_ / "run/layer/checkpoint").string();
  const Outcome stopped =
      shell(command(1, "run") + " & while ! [ -d " + saved +
            " ]; do sleep 0.02; done; kill -TERM " + process("run") + "; wait %1");
  expect_said(stopped, 143, {"--resume goes on from it"});
  ASSERT_TRUE(std::filesystem::exists(saved));
  expect_said(run(1, "run", "--resume --set seed=2"), 2, {"--set seed:", "accepted"});
  expect_said(run(1, "run", "--resume"), 0, {"going on from step", "cell-free layer"});
  expect_same("whole", "run");
  for (const char* rows : {"layer/profiles.csv", "layer/layer.csv"})
    EXPECT_EQ(content(directory_ / "whole" / rows), content(directory_ / "run" / rows)) << rows;
  EXPECT_FALSE(std::filesystem::exists(saved));
}

TEST_F(Faults, TwoRunsDoNotShareADirectory) {
  const std::string again = command(1, "run", "--force"), resume = command(1, "run", "--resume");
  const Outcome both =
      shell(in_background("run", "--set run.steps=200000") + "(" + again + "); echo again $?; (" +
            resume + "); echo resumed $?; kill -9 " + process("run") + "; wait");
  EXPECT_NE(both.said.find("again 2"), std::string::npos) << both.said;
  EXPECT_NE(both.said.find("resumed 2"), std::string::npos) << both.said;
  EXPECT_NE(both.said.find("is at work in it; accepted"), std::string::npos) << both.said;
  // The lock of the one that was killed is not in the way.
  EXPECT_EQ(run(1, "run", "--force --set run.steps=10").code, 0);
}

TEST_F(Faults, AWriteThatFailsHalfWayEndsTheRunAndKeepsThePreviousCheckpoint) {
  // On the way no file may grow beyond 300 kB any more, which the fluid's does.
  const Outcome failed = shell(
      "trap '' XFSZ; " + in_background("run", "--set run.steps=200000 --set output.fields=never") +
      "while ! [ -d " + (directory_ / "run/checkpoint").string() + " ]; do sleep 0.05; done; " +
      "prlimit --fsize=300000 --pid " + process("run") + "; kill -USR1 " + process("run") +
      "; wait %1");
  expect_said(failed, 4, {"hemomag: checkpoint.new/fluid.h5"});
  EXPECT_GT(saved_step("run/checkpoint"), 0);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "run/checkpoint.new"));
  const std::string further = std::to_string(saved_step("run/checkpoint") + 50);
  EXPECT_EQ(run(1, "run", "--resume --set output.fields=never --set run.steps=" + further).code, 0);
}

// One rank alone learns that the file did not grow.
TEST_F(Faults, AWriteThatFailsOnOneRankEndsAll) {
  const std::string saved = (directory_ / "half/checkpoint").string(),
                    program = HEMOMAG_BINARY " run case.toml --out half --set run.steps=200000 "
                                             "--set output.fields=never";
  const Outcome failed = shell(
      "cd " + directory_.string() + "; mpirun -np 2 sh -c \"trap '' XFSZ; exec " + program +
      "\" & while ! [ -d " + saved + " ]; do sleep 0.05; done; for p in $(pgrep -f '^" +
      HEMOMAG_BINARY " run case.toml --out half'); do prlimit --fsize=300000 --pid $p; done; " +
      "kill -USR1 " + process("half") + "; wait %1");
  expect_said(failed, 4, {"hemomag: checkpoint.new/fluid.h5"});
  EXPECT_GT(saved_step("half/checkpoint"), 0);
}

/// A disk of its own: needs the right to mount.
class Disk : public Faults {
protected:
  void SetUp() override {
    Faults::SetUp();
    std::filesystem::create_directories(directory_ / "disk");
    if (mount("tmpfs", disk().c_str(), "tmpfs", 0, "size=6m") != 0)
      GTEST_SKIP() << "a disk of its own needs the right to mount one";
    mounted_ = true;
  }
  void TearDown() override {
    if (mounted_) umount2(disk().c_str(), MNT_DETACH);
    Faults::TearDown();
  }
  std::string disk() const { return (directory_ / "disk").string(); }
  bool mounted_ = false;
};

TEST_F(Disk, AFullOneEndsTheRunAndKeepsThePreviousCheckpoint) {
  for (const int ranks : {1, 2}) {
    const std::string out = "disk/run" + std::to_string(ranks);
    const Outcome first = run(ranks, out, "--set run.steps=100 --set output.fields=never");
    ASSERT_EQ(first.code, 0) << first.said;
    // What is left is not enough for another one.
    const std::string fill = disk() + "/fill";
    shell("dd if=/dev/zero of=" + fill + " bs=64k");
    shell("truncate -s -300k " + fill);
    const Outcome full =
        run(ranks, out,
            "--resume --set run.steps=400 --set run.checkpoint='0 s' "
            "--set output.fields=never | grep -v '^step\\|^small\\|^going\\|s left'");
    const Outcome code = run(ranks, out,
                             "--resume --set run.steps=400 --set run.checkpoint='0 s' "
                             "--set output.fields=never");
    EXPECT_EQ(code.code, 4) << code.said;
    EXPECT_NE(full.said.find("hemomag: checkpoint.new"), std::string::npos) << full.said;
    if (ranks == 1) {
      EXPECT_EQ(lines(full.said), 1) << full.said;
    }
    EXPECT_EQ(saved_step(out + "/checkpoint"), 100);
    std::filesystem::remove(fill);
    EXPECT_EQ(run(ranks, out, "--resume --set run.steps=400 --set output.fields=never").code, 0);
    std::filesystem::remove_all(directory_ / out);
  }
}

TEST_F(Disk, SnapshotsThatFillItEndAllRanks) {
  for (const int size : {1000, 1100, 1200}) {
    const std::string kilobytes = "size=" + std::to_string(size) + "k";
    ASSERT_EQ(mount("tmpfs", disk().c_str(), "tmpfs", MS_REMOUNT, kilobytes.c_str()), 0);
    const Outcome full = shell(
        "timeout 100 sh -c '" +
        command(2, "disk/run", "--set run.checkpoint=never --set output.fields=\"30 us\"") + "'");
    expect_said(full, 4, {"hemomag: fields/"});
    std::filesystem::remove_all(directory_ / "disk/run");
  }
}

TEST_F(Disk, AReadOnlyOneIsRefused) {
  ASSERT_EQ(run(1, "disk/run", "--set run.steps=100").code, 0);
  ASSERT_EQ(mount("tmpfs", disk().c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, "size=6m"), 0);
  for (const std::string out : {"disk/run --resume --set run.steps=400", "disk/new"}) {
    const Outcome refused = run(1, out);
    EXPECT_EQ(refused.code, 4) << refused.said;
    EXPECT_NE(refused.said.find("Read-only file system"), std::string::npos) << refused.said;
  }
  EXPECT_EQ(saved_step("disk/run/checkpoint"), 100);
}

}  // namespace
}  // namespace hemomag::test
