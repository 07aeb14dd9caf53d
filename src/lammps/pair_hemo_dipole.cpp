#include "lammps/pair_hemo_dipole.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "utils.h"

#include "lammps/accident.hpp"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_drag.h"
#include "lammps/fix_hemo_field.h"
#include "magnetic/dipole_rows.hpp"

using namespace LAMMPS_NS;
namespace magnetic = hemomag::magnetic;
using hemomag::Vec3;

PairHemoDipole::PairHemoDipole(LAMMPS* lmp) : Pair(lmp) {
  single_enable = 0;
  no_virial_fdotr_compute = 1;
}

PairHemoDipole::~PairHemoDipole() {
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

void PairHemoDipole::allocate() {
  allocated = 1;
  types_ = atom->ntypes;
  memory->create(setflag, types_ + 1, types_ + 1, "pair:setflag");
  memory->create(cutsq, types_ + 1, types_ + 1, "pair:cutsq");
  for (int i = 0; i <= types_; ++i)
    for (int j = 0; j <= types_; ++j) setflag[i][j] = 0, cutsq[i][j] = 0;
  pairing_.resize(place(types_ + 1, 0));
}

void PairHemoDipole::settings(int narg, char** arg) {
  if (narg != 1)
    error->all(FLERR, std::string("pair_style hemo/dipole needs one argument, its cut-off"));
  cutoff_ = utils::numeric(FLERR, arg[0], false, lmp);
  if (!(cutoff_ > 0))
    error->all(FLERR, std::string("pair_style hemo/dipole: the cut-off must be > 0"));
}

/// pair_coeff I J CONTACT_DISTANCE soft KAPPA | paper EPSILON SIGMA
void PairHemoDipole::coeff(int narg, char** arg) {
  if (!allocated) allocate();
  const std::string usage = "pair_style hemo/dipole: pair_coeff I J CONTACT_DISTANCE soft KAPPA | "
                            "paper EPSILON SIGMA is expected";
  if (narg < 5) error->all(FLERR, usage);
  Pairing p;
  p.contact_distance = utils::numeric(FLERR, arg[2], false, lmp);
  const std::string kind = arg[3];
  if (kind == "soft" && narg == 5) {
    p.kappa = utils::numeric(FLERR, arg[4], false, lmp);
    p.reach2 = std::pow(magnetic::soft_reach(p.kappa, p.contact_distance), 2);
  } else if (kind == "paper" && narg == 6) {
    p.repulsion = Repulsion::paper;
    p.epsilon = utils::numeric(FLERR, arg[4], false, lmp);
    p.sigma = utils::numeric(FLERR, arg[5], false, lmp);
    p.reach2 = std::pow(p.contact_distance + p.sigma, 2);
  } else {
    error->all(FLERR, usage);
  }
  if (!(p.contact_distance > 0) || !(p.kappa > 0) ||
      (p.repulsion == Repulsion::paper && !(p.epsilon > 0 && p.sigma > 0)))
    error->all(FLERR, std::string("pair_style hemo/dipole: all coefficients must be > 0"));
  int ilo = 0, ihi = 0, jlo = 0, jhi = 0;
  utils::bounds(FLERR, std::string(arg[0]), 1, types_, ilo, ihi, error);
  utils::bounds(FLERR, std::string(arg[1]), 1, types_, jlo, jhi, error);
  for (int i = ilo; i <= ihi; ++i)
    for (int j = std::max(jlo, i); j <= jhi; ++j) {
      between(i, j) = between(j, i) = p;
      setflag[i][j] = 1;
    }
}

void PairHemoDipole::init_style() {
  field_ = hemomag::lammps::find_fix<FixHemoField>(lmp, "hemo/field");
  if (!field_)
    error->all(FLERR, std::string("pair_style hemo/dipole needs a fix hemo/field for its moments"));
  substepped_ = hemomag::lammps::find_fix<FixHemoDrag>(lmp, "hemo/drag") != nullptr;
  neighbor->request(this, instance_me);
}

double PairHemoDipole::init_one(int i, int j) {
  if (setflag[i][j] == 0)
    error->all(FLERR, "pair_style hemo/dipole: types " + std::to_string(i) + " and " +
                          std::to_string(j) + " have no coefficients; nothing is mixed");
  return cutoff_;
}

/// Force on j and energy of the contact, r from i to j.
magnetic::PairForce PairHemoDipole::repulsion_between(int i, int j, const Vec3& r) const {
  const Pairing& p = between(atom->type[i], atom->type[j]);
  if (norm2(r) >= p.reach2) return {};
  if (p.repulsion == Repulsion::soft) {
    const auto* m = reinterpret_cast<const Vec3*>(field_->moments()[0]);
    return magnetic::soft_repulsion(
        magnetic::contact_pull(norm(m[i]), norm(m[j]), p.contact_distance), p.kappa,
        p.contact_distance, r);
  }
  if (norm2(r) <= p.contact_distance * p.contact_distance) {
    hemomag::lammps::accident(lmp, "pair_style hemo/dipole",
                              "carriers " + std::to_string(atom->tag[i]) + " and " +
                                  std::to_string(atom->tag[j]) +
                                  " touch, where the repulsion of Eq. 26 is singular (use soft)");
    return {};
  }
  return magnetic::paper_repulsion(p.epsilon, p.sigma, p.contact_distance, r);
}

/// visit(i, j, r) for every pair of the list within the cut-off.
template <class Visit> void PairHemoDipole::for_each_pair(double** x_, Visit visit) const {
  if (list->inum == 0) return;
  const auto* x = reinterpret_cast<const Vec3*>(x_[0]);
  const double cut2 = cutoff_ * cutoff_;
  for (int a = 0; a < list->inum; ++a) {
    const int i = list->ilist[a];
    for (int b = 0; b < list->numneigh[i]; ++b) {
      const int j = list->firstneigh[i][b] & NEIGHMASK;
      const Vec3 r = x[j] - x[i];
      if (norm2(r) < cut2) visit(i, j, r);
    }
  }
}

void PairHemoDipole::accumulate(double** x_, double** f_) {
  if (list->inum == 0) return;
  const auto* x = reinterpret_cast<const Vec3*>(x_[0]);
  auto* f = reinterpret_cast<Vec3*>(f_[0]);
  int touching[magnetic::most_in_row];
  const double cut2 = cutoff_ * cutoff_;
  magnetic::DipoleRow row{x_[0],
                          field_->moments()[0],
                          f_[0],
                          0,
                          nullptr,
                          NEIGHMASK,
                          0,
                          cut2,
                          std::min(cut2, longest_reach2()),
                          touching};
  for (int a = 0; a < list->inum; ++a) {
    const int i = row.i = list->ilist[a], count = list->numneigh[i];
    for (int first = 0; first < count; first += magnetic::most_in_row) {
      row.neighbours = list->firstneigh[i] + first;
      row.count = std::min<std::ptrdiff_t>(count - first, magnetic::most_in_row);
      const auto n = magnetic::dipole_row(row);
      for (std::ptrdiff_t k = 0; k < n; ++k) {
        const int j = touching[k];
        const Vec3 on_j = repulsion_between(i, j, x[j] - x[i]).on_j;
        f[j] += on_j;
        f[i] -= on_j;
      }
    }
  }
}

/// Square of the distance from which on no pair repels.
double PairHemoDipole::longest_reach2() const {
  double reach2 = 0;
  for (int i = 1; i <= types_; ++i)
    for (int j = i; j <= types_; ++j)
      if (setflag[i][j]) reach2 = std::max(reach2, between(i, j).reach2);
  return reach2;
}

/// With fix hemo/drag defined the forces are its affair: only energy and virial are tallied here.
void PairHemoDipole::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  if (!substepped_) accumulate(atom->x, atom->f);
  if (!evflag) return;
  for_each_pair(atom->x, [&](int i, int j, const Vec3& r) {
    const auto* m = reinterpret_cast<const Vec3*>(field_->moments()[0]);
    const auto dipole = magnetic::dipole_dipole(m[i], m[j], r),
               contact = repulsion_between(i, j, r);
    const Vec3 on_j = dipole.on_j + contact.on_j;
    ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, 0.0, dipole.energy + contact.energy,
                 -on_j.x, -on_j.y, -on_j.z, -r.x, -r.y, -r.z);
  });
}

long PairHemoDipole::pairs() {
  long mine = 0, all = 0;
  for_each_pair(atom->x, [&](int, int, const Vec3&) { ++mine; });
  MPI_Allreduce(&mine, &all, 1, MPI_LONG, MPI_SUM, world);
  return all;
}

double PairHemoDipole::max_stiffness() {
  std::vector<double> strongest(static_cast<std::size_t>(types_) + 1, 0.0), all(strongest.size());
  double** m = field_->moments();
  for (int i = 0; i < atom->nlocal; ++i) {
    const auto type = static_cast<std::size_t>(atom->type[i]);
    strongest[type] = std::max(strongest[type], hemomag::norm(Vec3{m[i][0], m[i][1], m[i][2]}));
  }
  MPI_Allreduce(strongest.data(), all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_MAX,
                world);
  double stiffest = 0;
  for (int i = 1; i <= types_; ++i)
    for (int j = i; j <= types_; ++j) {
      if (!setflag[i][j]) continue;
      const Pairing& p = between(i, j);
      const double pull = magnetic::contact_pull(
          all[static_cast<std::size_t>(i)], all[static_cast<std::size_t>(j)], p.contact_distance);
      stiffest =
          std::max(stiffest, p.repulsion == Repulsion::soft
                                 ? magnetic::soft_stiffness(pull, p.kappa, p.contact_distance)
                                 : magnetic::paper_stiffness(pull, p.epsilon, p.sigma));
    }
  return stiffest;
}

void PairHemoDipole::write_restart_settings(FILE* file) {
  std::fwrite(&cutoff_, sizeof(double), 1, file);
}

void PairHemoDipole::read_restart_settings(FILE* file) {
  if (comm->me == 0) utils::sfread(FLERR, &cutoff_, sizeof(double), 1, file, nullptr, error);
  MPI_Bcast(&cutoff_, 1, MPI_DOUBLE, 0, world);
}

void PairHemoDipole::write_restart(FILE* file) {
  write_restart_settings(file);
  for (int i = 1; i <= types_; ++i)
    for (int j = i; j <= types_; ++j) {
      std::fwrite(&setflag[i][j], sizeof(int), 1, file);
      if (setflag[i][j]) std::fwrite(&between(i, j), sizeof(Pairing), 1, file);
    }
}

void PairHemoDipole::read_restart(FILE* file) {
  read_restart_settings(file);
  allocate();
  for (int i = 1; i <= types_; ++i)
    for (int j = i; j <= types_; ++j) {
      if (comm->me == 0) utils::sfread(FLERR, &setflag[i][j], sizeof(int), 1, file, nullptr, error);
      MPI_Bcast(&setflag[i][j], 1, MPI_INT, 0, world);
      if (!setflag[i][j]) continue;
      Pairing p;
      if (comm->me == 0) utils::sfread(FLERR, &p, sizeof(Pairing), 1, file, nullptr, error);
      MPI_Bcast(&p, sizeof(Pairing), MPI_BYTE, 0, world);
      between(i, j) = between(j, i) = p;
    }
}
