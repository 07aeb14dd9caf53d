#include "lammps/positions.hpp"

#include <mpi.h>

#include "atom.h"
#include "domain.h"
#include "lammps.h"

namespace hemomag::lammps {
namespace {

/// value(i) of owned atom i, gathered: every atom has one owner; the others add zeros.
template <class Value> std::vector<Vec3> by_tag(LAMMPS_NS::LAMMPS& lmp, Value value) {
  const auto* atom = lmp.atom;
  std::vector<Vec3> all(static_cast<std::size_t>(atom->natoms));
  for (int i = 0; i < atom->nlocal; ++i) all[static_cast<std::size_t>(atom->tag[i] - 1)] = value(i);
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(3 * all.size()), MPI_DOUBLE, MPI_SUM,
                lmp.world);
  return all;
}

}  // namespace

std::vector<Vec3> positions(LAMMPS_NS::LAMMPS& lmp) {
  return by_tag(lmp, [&](int i) {
    double unwrapped[3];
    lmp.domain->unmap(lmp.atom->x[i], lmp.atom->image[i], unwrapped);
    return Vec3{unwrapped[0], unwrapped[1], unwrapped[2]};
  });
}

std::vector<Vec3> velocities(LAMMPS_NS::LAMMPS& lmp) {
  double** v = lmp.atom->v;
  return by_tag(lmp, [v](int i) { return Vec3{v[i][0], v[i][1], v[i][2]}; });
}

std::vector<Vec3> forces(LAMMPS_NS::LAMMPS& lmp) {
  double** f = lmp.atom->f;
  return by_tag(lmp, [f](int i) { return Vec3{f[i][0], f[i][1], f[i][2]}; });
}

}  // namespace hemomag::lammps
