#include "lammps/ending.hpp"

#include <chrono>
#include <thread>

#include <unistd.h>

namespace hemomag::lammps {

Ending& ending() {
  static Ending of_this_process;
  return of_this_process;
}

std::FILE*& kept_log() {
  static std::FILE* of_this_process = nullptr;
  return of_this_process;
}

void end_by_file_trouble(MPI_Comm world, std::FILE* log, const std::string& reason) {
  constexpr int unstable = 3, file_trouble = 4;
  int rank = 0;
  MPI_Comm_rank(world, &rank);
  const bool ended_before = ending().cause == Cause::unstable && !ending().reason.empty();
  if (log) std::fprintf(log, "ERROR: %s\n", (ended_before ? ending().reason : reason).c_str());
  if (rank == 0 && ended_before)
    std::fprintf(stderr,
                 "hemomag: the run broke off: ERROR: %s\n"
                 "hemomag: its state could not be kept for inspection: %s\n",
                 ending().reason.c_str(), reason.c_str());
  else if (rank == 0)
    std::fprintf(stderr, "hemomag: %s\n", reason.c_str());
  std::fflush(nullptr);
  MPI_Barrier(world);
  // mpirun ends all ranks with the first that it sees go: that is the one whose line it still reads.
  if (rank != 0) std::this_thread::sleep_for(std::chrono::milliseconds(200));
  _exit(ended_before ? unstable : file_trouble);
}

}  // namespace hemomag::lammps
