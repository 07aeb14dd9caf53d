#include "lammps/bonded_forces.hpp"

#include <algorithm>

#include "angle.h"
#include "atom.h"
#include "bond.h"
#include "dihedral.h"
#include "force.h"
#include "lammps.h"

namespace hemomag::lammps {

void BondedForces::clear() const {
  std::fill_n(lmp_.atom->f[0], 3 * (lmp_.atom->nlocal + lmp_.atom->nghost), 0.0);
}
void BondedForces::bonds() const { lmp_.force->bond->compute(0, 0); }
void BondedForces::angles() const { lmp_.force->angle->compute(0, 0); }
void BondedForces::dihedrals() const { lmp_.force->dihedral->compute(0, 0); }
long BondedForces::atoms() const { return static_cast<long>(lmp_.atom->natoms); }

}  // namespace hemomag::lammps
