#pragma once
#include <vector>

#include "base/vec3.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace hemomag::lammps {

/// Positions of all atoms by tag - 1, unwrapped, on every rank. Collective.
std::vector<Vec3> positions(LAMMPS_NS::LAMMPS& lmp);

}  // namespace hemomag::lammps
