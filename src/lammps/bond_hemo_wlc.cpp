#include "lammps/bond_hemo_wlc.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neighbor.h"
#include "utils.h"

#include "base/vec3.hpp"
#include "lammps/accident.hpp"

using namespace LAMMPS_NS;
using hemomag::Vec3;

BondHemoWLC::BondHemoWLC(LAMMPS* lmp) : Bond(lmp) { writedata = 1; }

BondHemoWLC::~BondHemoWLC() {
  if (allocated) memory->destroy(setflag);
}

void BondHemoWLC::allocate() {
  allocated = 1;
  memory->create(setflag, atom->nbondtypes + 1, "bond:setflag");
  for (int type = 1; type <= atom->nbondtypes; ++type) setflag[type] = 0;
  coefficients_.resize(atom->nbondtypes);
  spring_.resize(static_cast<std::size_t>(atom->nbondtypes) + 1);
}

void BondHemoWLC::coeff(int narg, char** arg) {
  if (!allocated) allocate();
  if (narg != 1 + columns)
    error->all(FLERR,
               std::string("bond_style hemo/wlc: a type needs kBT x0 l_max mu0 m gammaC gammaT"));
  int lo = 0, hi = 0;
  utils::bounds(FLERR, std::string(arg[0]), 1, atom->nbondtypes, lo, hi, error);
  for (int type = lo; type <= hi; ++type) {
    for (std::size_t c = 0; c < columns; ++c)
      coefficients_[type][c] = utils::numeric(FLERR, arg[c + 1], false, lmp);
    derive(type);
  }
}

void BondHemoWLC::derive(int type) {
  const auto& c = coefficients_[type];
  if (!(c[x0] > 0 && c[x0] < 1) || !(c[l_max] > 0) || !(c[mu0] > 0) || !(c[exponent] > 1))
    error->all(FLERR, "bond_style hemo/wlc: type " + std::to_string(type) +
                          " needs 0 < x0 < 1, l_max > 0, mu0 > 0 and m > 1");
  spring_[static_cast<std::size_t>(type)] =
      hemomag::membrane::make_spring(c[x0], c[l_max], c[mu0], c[exponent]);
  setflag[type] = 1;
}

/// This rank's edges with their coefficients, in LAMMPS's order, exponent by exponent. With every
/// new list.
void BondHemoWLC::rebuild() {
  exponents_.clear();
  for (int type = 1; type <= coefficients_.types(); ++type)
    if (const double m = spring_[static_cast<std::size_t>(type)].m;
        std::find(exponents_.begin(), exponents_.end(), m) == exponents_.end())
      exponents_.push_back(m);
  edges_.clear();
  int** list = neighbor->bondlist;
  for (const double m : exponents_)
    for (int n = 0; n < neighbor->nbondlist; ++n)
      if (const auto& spring = spring_[static_cast<std::size_t>(list[n][2])]; spring.m == m)
        edges_.add(list[n][0], list[n][1], spring);
  edges_.finish();
}

void BondHemoWLC::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  if (topology_.changed(*neighbor)) rebuild();
  const int all = atom->nlocal + atom->nghost;
  const auto atoms = static_cast<std::size_t>(all);
  const std::span<const Vec3> x{reinterpret_cast<const Vec3*>(atom->x[0]), atoms};
  const auto broken = edges_.add_forces(x, {reinterpret_cast<Vec3*>(atom->f[0]), atoms});
  if (broken >= 0) {
    const int i = edges_.vertex(0, broken), j = edges_.vertex(1, broken);
    overstretched(i, j, norm(x[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(j)]),
                  edges_.l_max(broken));
  }
  if (evflag) tally(eflag);
}

/// Energy and virial, in the steps that ask for them. The forces of a step do not depend on it.
void BondHemoWLC::tally(int eflag) {
  const auto* x = reinterpret_cast<const Vec3*>(atom->x[0]);
  int** list = neighbor->bondlist;
  for (int n = 0; n < neighbor->nbondlist; ++n) {
    const int i = list[n][0], j = list[n][1];
    const auto& spring = spring_[static_cast<std::size_t>(list[n][2])];
    const Vec3 d = x[i] - x[j];
    const double l = norm(d);
    ev_tally(i, j, atom->nlocal, force->newton_bond,
             eflag ? hemomag::membrane::energy(spring, l) : 0.0, -tension(spring, l) / l, d.x, d.y,
             d.z);
  }
}

void BondHemoWLC::overstretched(int i, int j, double length, double limit) const {
  const std::string cell =
      atom->molecule[i] > 0 ? " of cell " + std::to_string(atom->molecule[i]) : std::string();
  hemomag::lammps::accident(lmp, "bond_style hemo/wlc",
                            "the edge between atoms " + std::to_string(atom->tag[i]) + " and " +
                                std::to_string(atom->tag[j]) + cell + " is " +
                                std::to_string(length) + " long, its limit is " +
                                std::to_string(limit) +
                                " (forces too strong, or the time step too long)");
}

double BondHemoWLC::greatest_stretch() const {
  const auto* x = reinterpret_cast<const Vec3*>(atom->x[0]);
  double most = 0;
  for (int n = 0; n < neighbor->nbondlist; ++n) {
    const int* bond = neighbor->bondlist[n];
    const auto type = static_cast<std::size_t>(bond[2]);
    if (setflag[type])  // with a hybrid style the list is of all kinds
      most = std::max(most, norm(x[bond[0]] - x[bond[1]]) / coefficients_[bond[2]][l_max]);
  }
  return most;
}

double BondHemoWLC::equilibrium_distance(int type) {
  return coefficients_[type][x0] * coefficients_[type][l_max];
}

void BondHemoWLC::write_restart(FILE* file) { coefficients_.write(file); }

void BondHemoWLC::read_restart(FILE* file) {
  allocate();
  coefficients_.read(file, comm->me, world, error);
  for (int type = 1; type <= atom->nbondtypes; ++type) derive(type);
}

void BondHemoWLC::write_data(FILE* file) { coefficients_.write_data(file); }

double BondHemoWLC::single(int type, double rsq, int, int, double& fforce) {
  const auto& spring = spring_[static_cast<std::size_t>(type)];
  const double l = std::sqrt(rsq);
  fforce = -tension(spring, l) / l;
  return hemomag::membrane::energy(spring, l);
}
