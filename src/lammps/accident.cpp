#include "lammps/accident.hpp"

#include "comm.h"
#include "update.h"

#include "lammps/compat.hpp"
#include "lammps/fix_hemo_watch.h"

namespace hemomag::lammps {

void accident(LAMMPS_NS::LAMMPS* lmp, const std::string& who, const std::string& what) {
  if (auto* watch = find_fix<LAMMPS_NS::FixHemoWatch>(lmp, "hemo/watch"))
    watch->note(who + ": " + what);
  else
    fail_here(lmp, FLERR,
              who + ": step " + std::to_string(lmp->update->ntimestep) + ", rank " +
                  std::to_string(lmp->comm->me) + ": " + what);
}

}  // namespace hemomag::lammps
