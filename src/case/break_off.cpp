#include "case/break_off.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include <unistd.h>

#include "io/checkpoint_directory.hpp"
#include "lammps/ending.hpp"

namespace hemomag::case_ {
namespace {

constexpr int unstable = 3, file_trouble = 4;
bool in_progress = false;
int this_rank = 0;

int code() {
  return lammps::ending().cause == lammps::Cause::file_trouble ? file_trouble : unstable;
}

/// The last error line of a log.
std::string last_error(std::FILE* log) {
  std::string reason;
  if (!log) return reason;
  std::rewind(log);
  for (char line[1000]; std::fgets(line, sizeof line, log);)
    if (std::strncmp(line, "ERROR", 5) == 0) reason = line;
  while (!reason.empty() && reason.back() == '\n') reason.pop_back();
  return reason;
}

/// What was said when the run ended, or the last error line of its log. Half a checkpoint must not
/// keep a full disk full.
void print_reason() {
  if (code() == file_trouble) {
    std::error_code ignored;
    std::filesystem::remove_all(io::unfinished(checkpoint_name), ignored);
  }
  if (!lammps::ending().reason.empty()) {
    std::fprintf(stderr, "hemomag: %s%s\n", code() == unstable ? "the run broke off: ERROR: " : "",
                 lammps::ending().reason.c_str());
    return;
  }
  std::FILE* log = this_rank == 0 ? std::fopen("log.lammps", "r") : lammps::kept_log();
  const std::string reason = last_error(log);
  std::fprintf(stderr, "hemomag: the run broke off: %s\n",
               reason.empty() ? "see the end of its log.lammps" : reason.c_str());
}

void at_exit() {
  if (!in_progress) return;
  if (this_rank == 0) print_reason();
  std::fflush(nullptr);
  _exit(code());
}

}  // namespace

RunInProgress::RunInProgress(int rank) {
  lammps::ending();  // made before at_exit is registered, it is still there when that is called
  static const int registered = std::atexit(at_exit);
  static_cast<void>(registered);
  this_rank = rank;
  in_progress = true;
}

RunInProgress::~RunInProgress() { in_progress = false; }

int code_of_abort() {
  if (in_progress || !lammps::ending().reason.empty()) print_reason();
  if (!in_progress) return 1;
  in_progress = false;
  return code();
}

}  // namespace hemomag::case_
