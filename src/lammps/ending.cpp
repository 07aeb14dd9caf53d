#include "lammps/ending.hpp"

#include <unistd.h>

namespace hemomag::lammps {

Ending& ending() {
  static Ending of_this_process;
  return of_this_process;
}

void end_by_file_trouble(MPI_Comm world, std::FILE* log, const std::string& reason) {
  constexpr int exit_code = 4;
  int rank = 0;
  MPI_Comm_rank(world, &rank);
  if (log) std::fprintf(log, "ERROR: %s\n", reason.c_str());
  if (rank == 0) std::fprintf(stderr, "hemomag: %s\n", reason.c_str());
  std::fflush(nullptr);
  MPI_Barrier(world);  // the line is out before a rank is seen to end
  _exit(exit_code);
}

}  // namespace hemomag::lammps
