#pragma once
#include "lmptype.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace hemomag::lammps {

/// Make the triangles (angles) of every cell agree on one sense of rotation, that of the majority,
/// by exchanging the first and third atom of those that differ: some public cell files list a few
/// triangles inside out, which spoils signed volumes. A cell is looked at as a whole on the rank
/// its id falls to. Collective, once, before the first neighbour list.
/// @param is_triangle  [angle type], non-zero for types that are membrane triangles
/// @return number of triangles turned, over all ranks
LAMMPS_NS::bigint orient_triangles(LAMMPS_NS::LAMMPS& lmp, const int* is_triangle);

}  // namespace hemomag::lammps
