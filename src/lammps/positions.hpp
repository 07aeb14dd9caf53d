#pragma once
#include <vector>

#include "base/vec3.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace hemomag::lammps {

/// Of all atoms by tag - 1, on every rank. Collective. Positions are unwrapped.
std::vector<Vec3> positions(LAMMPS_NS::LAMMPS& lmp);
std::vector<Vec3> velocities(LAMMPS_NS::LAMMPS& lmp);
std::vector<Vec3> forces(LAMMPS_NS::LAMMPS& lmp);

}  // namespace hemomag::lammps
