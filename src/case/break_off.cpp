#include "case/break_off.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include <unistd.h>

namespace hemomag::case_ {
namespace {

constexpr int unstable = 3;
bool in_progress = false;
int this_rank = 0;

/// The last error line of the run's log; only rank 0 has one.
void print_reason() {
  std::ifstream log("log.lammps");
  std::string reason;
  for (std::string line; std::getline(log, line);)
    if (line.rfind("ERROR", 0) == 0) reason = line;
  std::fprintf(stderr, "hemomag: the run broke off: %s\n",
               reason.empty() ? "see the end of its log.lammps" : reason.c_str());
}

void at_exit() {
  if (!in_progress) return;
  if (this_rank == 0) print_reason();
  std::fflush(nullptr);
  _exit(unstable);
}

}  // namespace

RunInProgress::RunInProgress(int rank) {
  static const int registered = std::atexit(at_exit);
  static_cast<void>(registered);
  this_rank = rank;
  in_progress = true;
}

RunInProgress::~RunInProgress() { in_progress = false; }

int code_of_abort() {
  if (!in_progress) return 1;
  in_progress = false;
  if (this_rank == 0) print_reason();
  return unstable;
}

}  // namespace hemomag::case_
