#include "lammps/style_table.hpp"

#include "force.h"
#include "lammps.h"
#include "modify.h"

#include "lammps/angle_hemo_membrane.h"
#include "lammps/bond_hemo_wlc.h"
#include "lammps/compute_hemo_cell.h"
#include "lammps/compute_hemo_margination.h"
#include "lammps/dihedral_hemo_bend.h"
#include "lammps/fix_hemo_advect.h"
#include "lammps/fix_hemo_cells.h"
#include "lammps/fix_hemo_checkpoint.h"
#include "lammps/fix_hemo_contact.h"
#include "lammps/fix_hemo_drag.h"
#include "lammps/fix_hemo_field.h"
#include "lammps/fix_hemo_fluid.h"
#include "lammps/fix_hemo_profiles.h"
#include "lammps/fix_hemo_progress.h"
#include "lammps/fix_hemo_series.h"
#include "lammps/fix_hemo_snapshot.h"
#include "lammps/fix_hemo_wall.h"
#include "lammps/fix_hemo_watch.h"
#include "lammps/pair_hemo_contact.h"
#include "lammps/pair_hemo_dipole.h"

namespace hemomag::lammps {
namespace {

template <class Style> LAMMPS_NS::Fix* new_fix(LAMMPS_NS::LAMMPS* lmp, int argc, char** argv) {
  return new Style(lmp, argc, argv);
}
template <class Style>
LAMMPS_NS::Compute* new_compute(LAMMPS_NS::LAMMPS* lmp, int argc, char** argv) {
  return new Style(lmp, argc, argv);
}
template <class Base, class Style> Base* new_force(LAMMPS_NS::LAMMPS* lmp) {
  return new Style(lmp);
}

}  // namespace

void register_styles(LAMMPS_NS::LAMMPS& lmp) {
  auto& fixes = *lmp.modify->fix_map;
  auto& computes = *lmp.modify->compute_map;
  auto& pairs = *lmp.force->pair_map;
  auto& bonds = *lmp.force->bond_map;
  auto& angles = *lmp.force->angle_map;
  auto& dihedrals = *lmp.force->dihedral_map;

  fixes["hemo/advect"] = new_fix<LAMMPS_NS::FixHemoAdvect>;
  fixes["hemo/cells"] = new_fix<LAMMPS_NS::FixHemoCells>;
  fixes["hemo/checkpoint"] = new_fix<LAMMPS_NS::FixHemoCheckpoint>;
  fixes["hemo/contact"] = new_fix<LAMMPS_NS::FixHemoContact>;
  fixes["hemo/drag"] = new_fix<LAMMPS_NS::FixHemoDrag>;
  fixes["hemo/field"] = new_fix<LAMMPS_NS::FixHemoField>;
  fixes["hemo/fluid"] = new_fix<LAMMPS_NS::FixHemoFluid>;
  fixes["hemo/profiles"] = new_fix<LAMMPS_NS::FixHemoProfiles>;
  fixes["hemo/progress"] = new_fix<LAMMPS_NS::FixHemoProgress>;
  fixes["hemo/series"] = new_fix<LAMMPS_NS::FixHemoSeries>;
  fixes["hemo/snapshot"] = new_fix<LAMMPS_NS::FixHemoSnapshot>;
  fixes["hemo/wall"] = new_fix<LAMMPS_NS::FixHemoWall>;
  fixes["hemo/watch"] = new_fix<LAMMPS_NS::FixHemoWatch>;
  computes["hemo/cell"] = new_compute<LAMMPS_NS::ComputeHemoCell>;
  computes["hemo/margination"] = new_compute<LAMMPS_NS::ComputeHemoMargination>;
  pairs["hemo/contact"] = new_force<LAMMPS_NS::Pair, LAMMPS_NS::PairHemoContact>;
  pairs["hemo/dipole"] = new_force<LAMMPS_NS::Pair, LAMMPS_NS::PairHemoDipole>;
  bonds["hemo/wlc"] = new_force<LAMMPS_NS::Bond, LAMMPS_NS::BondHemoWLC>;
  angles["hemo/membrane"] = new_force<LAMMPS_NS::Angle, LAMMPS_NS::AngleHemoMembrane>;
  dihedrals["hemo/bend"] = new_force<LAMMPS_NS::Dihedral, LAMMPS_NS::DihedralHemoBend>;
}

}  // namespace hemomag::lammps
