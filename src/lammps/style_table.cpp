#include "lammps/style_table.hpp"

#include "force.h"
#include "lammps.h"
#include "modify.h"

namespace hemomag::lammps {
namespace {

template <class Style>
LAMMPS_NS::Fix* new_fix(LAMMPS_NS::LAMMPS* lmp, int argc, char** argv) {
  return new Style(lmp, argc, argv);
}
template <class Style>
LAMMPS_NS::Compute* new_compute(LAMMPS_NS::LAMMPS* lmp, int argc, char** argv) {
  return new Style(lmp, argc, argv);
}
template <class Base, class Style>
Base* new_force(LAMMPS_NS::LAMMPS* lmp) {
  return new Style(lmp);
}

}  // namespace

void register_styles(LAMMPS_NS::LAMMPS& lmp) {
  [[maybe_unused]] auto& fixes = *lmp.modify->fix_map;
  [[maybe_unused]] auto& computes = *lmp.modify->compute_map;
  [[maybe_unused]] auto& pairs = *lmp.force->pair_map;
  [[maybe_unused]] auto& bonds = *lmp.force->bond_map;
  [[maybe_unused]] auto& angles = *lmp.force->angle_map;
  [[maybe_unused]] auto& dihedrals = *lmp.force->dihedral_map;

  // One line a style.
}

}  // namespace hemomag::lammps
