#include "lammps/dihedral_hemo_bend.h"

#include <cmath>
#include <numbers>
#include <string>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neighbor.h"
#include "utils.h"

using namespace LAMMPS_NS;
using hemomag::Vec3;

DihedralHemoBend::DihedralHemoBend(LAMMPS* lmp) : Dihedral(lmp) { writedata = 1; }

DihedralHemoBend::~DihedralHemoBend() {
  if (allocated) memory->destroy(setflag);
}

void DihedralHemoBend::allocate() {
  allocated = 1;
  memory->create(setflag, atom->ndihedraltypes + 1, "dihedral:setflag");
  for (int type = 1; type <= atom->ndihedraltypes; ++type) setflag[type] = 0;
  coefficients_.resize(atom->ndihedraltypes);
  bending_.resize(static_cast<std::size_t>(atom->ndihedraltypes) + 1);
}

void DihedralHemoBend::coeff(int narg, char** arg) {
  if (!allocated) allocate();
  if (narg != 1 + columns)
    error->all(FLERR, std::string("dihedral_style hemo/bend: a type needs k_b theta_0 (degrees)"));
  int lo = 0, hi = 0;
  utils::bounds(FLERR, std::string(arg[0]), 1, atom->ndihedraltypes, lo, hi, error);
  for (int type = lo; type <= hi; ++type) {
    for (std::size_t c = 0; c < columns; ++c)
      coefficients_[type][c] = utils::numeric(FLERR, arg[c + 1], false, lmp);
    derive(type);
  }
}

void DihedralHemoBend::derive(int type) {
  const double theta = coefficients_[type][theta_0] * std::numbers::pi / 180;
  if (!(std::fabs(theta) < std::numbers::pi) || coefficients_[type][k_b] < 0)
    error->all(FLERR, "dihedral_style hemo/bend: type " + std::to_string(type) +
                          " needs k_b >= 0 and theta_0 between -180 and 180 degrees");
  bending_[static_cast<std::size_t>(type)] = {coefficients_[type][k_b], std::sin(theta),
                                              std::cos(theta)};
  setflag[type] = 1;
}

/// This rank's hinges with their coefficients, in LAMMPS's order. With every new list.
void DihedralHemoBend::rebuild() {
  hinges_.clear();
  int** list = neighbor->dihedrallist;
  for (int n = 0; n < neighbor->ndihedrallist; ++n)
    hinges_.add({list[n][0], list[n][1], list[n][2], list[n][3]},
                bending_[static_cast<std::size_t>(list[n][4])]);
  hinges_.finish();
}

void DihedralHemoBend::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  if (topology_.changed(*neighbor)) rebuild();
  const int all = atom->nlocal + atom->nghost;
  const auto atoms = static_cast<std::size_t>(all);
  hinges_.add_forces({reinterpret_cast<const Vec3*>(atom->x[0]), atoms},
                     {reinterpret_cast<Vec3*>(atom->f[0]), atoms});
  if (evflag) tally(eflag);
}

/// Energy and virial, in the steps that ask for them. The forces of a step do not depend on it.
void DihedralHemoBend::tally(int eflag) {
  const auto* x = reinterpret_cast<const Vec3*>(atom->x[0]);
  int** list = neighbor->dihedrallist;
  for (int n = 0; n < neighbor->ndihedrallist; ++n) {
    const int i1 = list[n][0], i2 = list[n][1], i3 = list[n][2], i4 = list[n][3];
    const auto& bending = bending_[static_cast<std::size_t>(list[n][4])];
    const auto hinge = hemomag::membrane::make_hinge(x[i1], x[i2], x[i3], x[i4]);
    auto F = hemomag::membrane::forces(bending, hinge, x[i1], x[i2], x[i4]);
    const Vec3 b1 = x[i1] - x[i2], b2 = x[i3] - x[i2], b3 = x[i4] - x[i3];
    ev_tally(i1, i2, i3, i4, atom->nlocal, force->newton_bond,
             eflag ? hemomag::membrane::energy(bending, hinge.theta) : 0.0, &F.f1.x, &F.f3.x,
             &F.f4.x, b1.x, b1.y, b1.z, b2.x, b2.y, b2.z, b3.x, b3.y, b3.z);
  }
}

void DihedralHemoBend::write_restart(FILE* file) { coefficients_.write(file); }

void DihedralHemoBend::read_restart(FILE* file) {
  allocate();
  coefficients_.read(file, comm->me, world, error);
  for (int type = 1; type <= atom->ndihedraltypes; ++type) derive(type);
}

void DihedralHemoBend::write_data(FILE* file) { coefficients_.write_data(file); }
