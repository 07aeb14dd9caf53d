#pragma once
#include "lmptype.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace hemomag::lammps {

/// Turn every listed triangle (angle) the way its hinges (dihedrals) say is outwards, by exchanging its first and third
/// atom where they disagree: some public cell files list a few triangles the wrong way round, which spoils signed
/// volumes. Triangles without a hinge keep their order. Collective, once, before the first neighbour list.
/// @return number of triangles turned, over all ranks
LAMMPS_NS::bigint orient_triangles(LAMMPS_NS::LAMMPS& lmp);

}  // namespace hemomag::lammps
