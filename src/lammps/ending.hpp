#pragma once
#include <cstdio>
#include <string>

#include <mpi.h>

namespace hemomag::lammps {

/// Why a run ends before its last step: LAMMPS ends the process itself, and the program around it
/// wants to say more than exit code 1.
enum class Cause { unstable, file_trouble };

struct Ending {
  Cause cause = Cause::unstable;
  std::string reason;  ///< one line, or empty: see LAMMPS's own message
};

/// That of this process, set before LAMMPS is told of an error.
Ending& ending();

/// LAMMPS's messages on a rank other than 0, when they are kept (Host::keep_log), or null.
std::FILE*& kept_log();

/// A file or the disk ends the run on all ranks, with exit code 4 and one line on standard error;
/// a run that ends already, being unsound, keeps that as its reason, and exit code 3.
/// LAMMPS is not asked to: it would end MPI, and with it HDF5, which crashes over a file that it
/// could not write. Collective.
/// @param log  LAMMPS's, or null
[[noreturn]] void end_by_file_trouble(MPI_Comm world, std::FILE* log, const std::string& reason);

}  // namespace hemomag::lammps
