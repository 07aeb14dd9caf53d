#include "lammps/pair_hemo_contact.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neigh_list.h"
#include "utils.h"

#include "base/vec3.hpp"

using namespace LAMMPS_NS;
using hemomag::Vec3;

PairHemoContact::PairHemoContact(LAMMPS* lmp) : Pair(lmp) {
  writedata = 0;
  single_enable = 1;
}

PairHemoContact::~PairHemoContact() {
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

void PairHemoContact::allocate() {
  allocated = 1;
  types_ = atom->ntypes;
  memory->create(setflag, types_ + 1, types_ + 1, "pair:setflag");
  memory->create(cutsq, types_ + 1, types_ + 1, "pair:cutsq");
  for (int i = 0; i <= types_; ++i)
    for (int j = 0; j <= types_; ++j) setflag[i][j] = 0, cutsq[i][j] = 0;
  contact_.resize(place(types_ + 1, 0));
}

void PairHemoContact::settings(int narg, char**) {
  if (narg != 0) error->all(FLERR, std::string("pair_style hemo/contact takes no arguments"));
}

void PairHemoContact::set(int i, int j, const Contact& contact) {
  between(i, j) = between(j, i) = contact;
  setflag[i][j] = 1;
}

/// pair_coeff I J [morse DEPTH BETA R0 CUTOFF] [lj EPSILON SIGMA]
void PairHemoContact::coeff(int narg, char** arg) {
  if (!allocated) allocate();
  Contact c;
  for (int at = 2; at < narg;) {
    const std::string key = arg[at++];
    const auto number = [&] {
      if (at >= narg) error->all(FLERR, "pair_style hemo/contact: " + key + " needs more values");
      return utils::numeric(FLERR, arg[at++], false, lmp);
    };
    if (key == "morse") {
      c.morse.depth = number();
      c.morse.beta = number();
      c.morse.r0 = number();
      c.morse.cutoff = number();
      c.morse_cut2 = c.morse.depth > 0 ? c.morse.cutoff * c.morse.cutoff : 0;
    } else if (key == "lj") {
      c.lj.epsilon = number();
      c.lj.sigma = number();
      c.lj_cut2 = std::pow(hemomag::contact::lj_cutoff_over_sigma * c.lj.sigma, 2);
    } else {
      error->all(FLERR, "pair_style hemo/contact: " + key +
                            " is unknown; accepted: morse DEPTH BETA R0 CUTOFF, lj EPSILON SIGMA");
    }
  }
  if (c.morse.depth < 0 || c.lj.epsilon < 0 || c.lj.sigma < 0 || c.morse.cutoff < 0)
    error->all(
        FLERR,
        std::string(
            "pair_style hemo/contact: depth, epsilon, sigma and cutoff must not be negative"));
  int ilo = 0, ihi = 0, jlo = 0, jhi = 0;
  utils::bounds(FLERR, std::string(arg[0]), 1, types_, ilo, ihi, error);
  utils::bounds(FLERR, std::string(arg[1]), 1, types_, jlo, jhi, error);
  for (int i = ilo; i <= ihi; ++i)
    for (int j = std::max(jlo, i); j <= jhi; ++j) set(i, j, c);
}

double PairHemoContact::init_one(int i, int j) {
  if (setflag[i][j] == 0)
    error->all(FLERR, "pair_style hemo/contact: types " + std::to_string(i) + " and " +
                          std::to_string(j) + " have no coefficients; nothing is mixed");
  const auto& c = between(i, j);
  return std::sqrt(std::max(c.morse_cut2, c.lj_cut2));
}

double PairHemoContact::force_over_r(const Contact& c, double r2) {
  double f = 0;
  if (r2 < c.lj_cut2) f = hemomag::contact::force_over_r(c.lj, r2);
  if (r2 < c.morse_cut2) {
    const double r = std::sqrt(r2);
    f += hemomag::contact::force(c.morse, r) / r;
  }
  return f;
}

double PairHemoContact::energy(const Contact& c, double r2) {
  double e = 0;
  if (r2 < c.lj_cut2) e = hemomag::contact::energy(c.lj, r2);
  if (r2 < c.morse_cut2) e += hemomag::contact::energy(c.morse, std::sqrt(r2));
  return e;
}

void PairHemoContact::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  const auto* x = reinterpret_cast<const Vec3*>(atom->x[0]);
  auto* f = reinterpret_cast<Vec3*>(atom->f[0]);
  const int* type = atom->type;
  const double* special = force->special_lj;
  for (int a = 0; a < list->inum; ++a) {
    const int i = list->ilist[a];
    const Vec3 xi = x[i];
    const Contact* row = &contact_[place(type[i], 0)];
    const int* neighbours = list->firstneigh[i];
    Vec3 fi;
    for (int b = 0; b < list->numneigh[i]; ++b) {
      const double factor = special[sbmask(neighbours[b])];
      const int j = neighbours[b] & NEIGHMASK;
      const Vec3 d = xi - x[j];
      const double r2 = norm2(d);
      const Contact& c = row[type[j]];
      if (r2 >= c.morse_cut2 && r2 >= c.lj_cut2) continue;
      const double pair = factor * force_over_r(c, r2);
      fi += pair * d;
      f[j] -= pair * d;
      if (evflag)
        ev_tally(i, j, atom->nlocal, force->newton_pair, eflag ? factor * energy(c, r2) : 0.0, 0.0,
                 pair, d.x, d.y, d.z);
    }
    f[i] += fi;
  }
  if (vflag_fdotr) virial_fdotr_compute();
}

double PairHemoContact::single(int, int, int itype, int jtype, double rsq, double, double factor_lj,
                               double& fforce) {
  const auto& c = between(itype, jtype);
  fforce = factor_lj * force_over_r(c, rsq);
  return factor_lj * energy(c, rsq);
}

void PairHemoContact::write_restart(FILE* file) {
  for (int i = 1; i <= types_; ++i)
    for (int j = i; j <= types_; ++j) {
      std::fwrite(&setflag[i][j], sizeof(int), 1, file);
      if (setflag[i][j]) std::fwrite(&between(i, j), sizeof(Contact), 1, file);
    }
}

void PairHemoContact::read_restart(FILE* file) {
  allocate();
  for (int i = 1; i <= types_; ++i)
    for (int j = i; j <= types_; ++j) {
      int given = 0;
      Contact c;
      if (comm->me == 0) {
        utils::sfread(FLERR, &given, sizeof(int), 1, file, nullptr, error);
        if (given) utils::sfread(FLERR, &c, sizeof(Contact), 1, file, nullptr, error);
      }
      MPI_Bcast(&given, 1, MPI_INT, 0, world);
      MPI_Bcast(&c, sizeof(Contact), MPI_BYTE, 0, world);
      if (given) set(i, j, c);
    }
}
