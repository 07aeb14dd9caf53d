#pragma once
#include <string>

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

}  // namespace hemomag::lammps
