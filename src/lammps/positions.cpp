#include "lammps/positions.hpp"

#include <mpi.h>

#include "atom.h"
#include "domain.h"
#include "lammps.h"

namespace hemomag::lammps {

std::vector<Vec3> positions(LAMMPS_NS::LAMMPS& lmp) {
  const auto* atom = lmp.atom;
  std::vector<Vec3> x(static_cast<std::size_t>(atom->natoms));
  for (int i = 0; i < atom->nlocal; ++i) {
    double unwrapped[3];
    lmp.domain->unmap(atom->x[i], atom->image[i], unwrapped);
    x[static_cast<std::size_t>(atom->tag[i] - 1)] = {unwrapped[0], unwrapped[1], unwrapped[2]};
  }
  // Every atom has one owner; the others add zeros.
  MPI_Allreduce(MPI_IN_PLACE, x.data(), static_cast<int>(3 * x.size()), MPI_DOUBLE, MPI_SUM,
                lmp.world);
  return x;
}

}  // namespace hemomag::lammps
