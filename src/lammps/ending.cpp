#include "lammps/ending.hpp"

namespace hemomag::lammps {

Ending& ending() {
  static Ending of_this_process;
  return of_this_process;
}

}  // namespace hemomag::lammps
