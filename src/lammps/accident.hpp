#pragma once
#include <string>

#include "lammps.h"

namespace hemomag::lammps {

/// What this rank alone has met makes the run unsound. With a fix hemo/watch the step goes on, and
/// the watch ends the run on all ranks before it is over; without one this rank ends it here: the
/// caller must be able to go on to the end of the step.
/// @param who   the style that met it
/// @param what  atoms, values and likely cause
void accident(LAMMPS_NS::LAMMPS* lmp, const std::string& who, const std::string& what);

}  // namespace hemomag::lammps
