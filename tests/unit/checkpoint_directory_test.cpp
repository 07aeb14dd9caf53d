// Wherever a process ends while it writes a checkpoint, the latest whole one is found and kept.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/error.hpp"
#include "io/checkpoint_directory.hpp"
#include "io/files.hpp"

namespace {

using namespace hemomag;
namespace fs = std::filesystem;

class Checkpoints : public testing::Test {
protected:
  void TearDown() override { fs::remove_all(parent_); }
  void SetUp() override { io::make_directory(parent_); }
  void begin(double bytes = 0) { io::begin_checkpoint(MPI_COMM_SELF, name_, bytes); }
  void write(long step) {
    begin();
    io::replace_file(io::unfinished(name_) + "/state", std::to_string(step));
    io::finish_checkpoint(MPI_COMM_SELF, name_, {"state"}, {step, 1.0, 1});
  }
  io::WholeCheckpoint find() { return io::find_checkpoint(MPI_COMM_SELF, name_); }

  const std::string parent_ =
      (fs::temp_directory_path() / ("hemomag_checkpoints_" + std::to_string(getpid()))).string();
  const std::string name_ = parent_ + "/checkpoint";
};

TEST_F(Checkpoints, TheLatestIsFoundAndTheOneBeforeItKept) {
  for (const long step : {100, 200, 300}) write(step);
  EXPECT_EQ(find().record.step, 300);
  fs::remove_all(name_);
  EXPECT_EQ(find().record.step, 200);
}

// Sealed, but without its name: it is the latest, and the next one must not be begun in its place.
TEST_F(Checkpoints, OneThatHasNotGotItsNameYetIsKept) {
  write(100);
  write(200);
  fs::rename(name_, io::unfinished(name_));
  fs::rename(name_ + ".previous", name_);
  EXPECT_EQ(find().directory, io::unfinished(name_));
  begin();
  EXPECT_EQ(find().record.step, 200);
  EXPECT_EQ(find().directory, name_);
  fs::remove_all(name_);
  EXPECT_EQ(find().record.step, 100);
}

TEST_F(Checkpoints, BetweenTheTwoRenamesNothingIsLost) {
  write(100);
  write(200);
  fs::rename(name_, io::unfinished(name_));
  EXPECT_EQ(find().record.step, 200);
  begin();
  EXPECT_EQ(find().record.step, 200);
}

TEST_F(Checkpoints, NoRoomLosesNothing) {
  write(100);
  write(200);
  fs::rename(name_, io::unfinished(name_));
  fs::rename(name_ + ".previous", name_);
  EXPECT_THROW(begin(1e30), FileError);
  EXPECT_EQ(find().record.step, 200);
}

}  // namespace
