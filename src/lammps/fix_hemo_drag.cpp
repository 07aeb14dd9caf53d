#include "lammps/fix_hemo_drag.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

#include "lammps/compat.hpp"
#include "lammps/fix_hemo_fluid.h"
#include "lammps/fix_state.hpp"
#include "lammps/pair_hemo_dipole.h"

using namespace LAMMPS_NS;

FixHemoDrag::FixHemoDrag(LAMMPS* lmp, int narg, char** arg)
    : Fix(lmp, narg, arg), radius_(static_cast<std::size_t>(atom->ntypes) + 1, 0.0),
      mobility_(radius_.size(), 0.0) {
  time_integrate = 1;
  scalar_flag = 1;
  global_freq = 1;
  extscalar = 0;
  comm_forward = comm_reverse = 3;
  restart_global = restart_peratom = 1;
  for (int at = 3; at < narg;) {
    const std::string key = arg[at++];
    if (key == "radius" && at + 1 < narg) {
      const int type = utils::inumeric(FLERR, arg[at++], false, lmp);
      const double a = utils::numeric(FLERR, arg[at++], false, lmp);
      if (type < 1 || type > atom->ntypes || a <= 0)
        error->all(
            FLERR,
            std::string("fix hemo/drag: radius TYPE A needs an atom type of the system and A > 0"));
      radius_[static_cast<std::size_t>(type)] = a;
    } else if (key == "feedback" && at < narg) {
      const std::string word = arg[at++];
      if (word != "yes" && word != "no")
        error->all(FLERR, "fix hemo/drag: feedback " + word + "; accepted: yes, no");
      feedback_ = word == "yes";
    } else {
      error->all(FLERR, "fix hemo/drag: " + key +
                            " is unknown or lacks values; accepted: radius TYPE A, "
                            "feedback yes|no");
    }
  }
  FixHemoDrag::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  for (int i = 0; i < atom->nlocal; ++i) set_arrays(i);
}

FixHemoDrag::~FixHemoDrag() {
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  memory->destroy(mean_stiff_);
  memory->destroy(stiff_);
}

int FixHemoDrag::setmask() { return FixConst::INITIAL_INTEGRATE | FixConst::POST_FORCE; }

void FixHemoDrag::init() {
  fluid_ = hemomag::lammps::find_fix<FixHemoFluid>(lmp, "hemo/fluid");
  if (!fluid_) error->all(FLERR, std::string("fix hemo/drag needs a fix hemo/fluid"));
  dipoles_ = dynamic_cast<PairHemoDipole*>(force->pair_match("hemo/dipole", 1));
  for (std::size_t type = 1; type < radius_.size(); ++type)
    if (radius_[type] > 0) mobility_[type] = 1.0 / bare_friction(radius_[type]);
  int without_radius = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & groupbit) && radius_[static_cast<std::size_t>(atom->type[i])] == 0)
      without_radius = atom->type[i];
  int any = 0;
  MPI_Allreduce(&without_radius, &any, 1, MPI_INT, MPI_MAX, world);
  if (any)
    error->all(FLERR, "fix hemo/drag: atoms of type " + std::to_string(any) + " have no radius");
  chosen_at_ = -1;
}

/// Friction of the point particle. A point coupled by a kernel already moves with the mobility 1/(6
/// pi mu R) of the kernel's own radius R, so that 1/Gamma_bare = 1/(6 pi mu a) - 1/(6 pi mu R)
/// makes the whole that of a sphere of radius a. Without feedback there is no such share and
/// Gamma_bare = 6 pi mu a. Differs from the paper, which puts 6 pi mu a into the coupled scheme:
/// mobility too high by a/R.
double FixHemoDrag::bare_friction(double a) const {
  const double stokes = 6 * std::numbers::pi * fluid_->viscosity() * a;
  if (!feedback_) return stokes;
  const double R = fluid_->point_radius();
  if (a >= R)
    error->all(FLERR, "fix hemo/drag: a carrier of radius " + std::to_string(a) +
                          " nodes is larger than the kernel's hydrodynamic radius " +
                          std::to_string(R) +
                          "; its friction cannot be corrected (use a larger dx)");
  return stokes / (1 - a / R);
}

/// n_sub = ceil(2 k dt/Gamma): the stiffest mode of a chain of contacts has 4 k/Gamma, an explicit
/// step is stable below 2 of it. Chosen anew for every neighbour list, since moments grow as
/// carriers approach a magnet.
void FixHemoDrag::choose_substeps() {
  if (!dipoles_ || chosen_at_ == neighbor->lastcall) return;
  chosen_at_ = neighbor->lastcall;
  const double softest = *std::max_element(mobility_.begin(), mobility_.end());
  const double needed = std::ceil(2 * dipoles_->max_stiffness() * softest);
  if (!(needed <= most_substeps))
    error->all(FLERR, "fix hemo/drag: step " + std::to_string(update->ntimestep) +
                          ": the contact forces need " + std::to_string(needed) +
                          " sub-steps, more than " + std::to_string(most_substeps) +
                          " (field too strong, or dt too long)");
  substeps_ = std::max(1, static_cast<int>(needed));
}

/// Dipole and contact forces of owned carriers at the present positions, into stiff_.
void FixHemoDrag::stiff_forces() {
  const int all = atom->nlocal + atom->nghost;
  if (all > 0) std::fill_n(stiff_[0], 3 * all, 0.0);
  dipoles_->accumulate(atom->x, stiff_);
  comm->reverse_comm_fix(this);
}

void FixHemoDrag::setup(int vflag) {
  if (!started_ && dipoles_) {
    stiff_forces();
    for (int i = 0; i < atom->nlocal; ++i)
      for (int d = 0; d < 3; ++d) mean_stiff_[i][d] = stiff_[i][d];
  }
  started_ = true;
  post_force(vflag);
}

/// u_b = u_f + F/Gamma_bare (Eqs. 33, 35 without inertia), the stiff part of F renewed n_sub times
/// a step. Differs from the paper: explicit Verlet with m du/dt = -Gamma (u_b - u_f) + F is
/// unstable at its parameters.
void FixHemoDrag::initial_integrate(int) {
  fluid_->velocity_at_atoms(groupbit, atom->v);
  choose_substeps();
  double **x = atom->x, **v = atom->v, **f = atom->f;
  const double part = 1.0 / substeps_;
  const int n = atom->nlocal;
  const auto carrier = [&](int i) { return (atom->mask[i] & groupbit) != 0; };
  for (int i = 0; i < n; ++i) {
    if (!carrier(i)) continue;
    const double mobility = mobility_[static_cast<std::size_t>(atom->type[i])];
    for (int d = 0; d < 3; ++d) {
      v[i][d] += mobility * (f[i][d] - mean_stiff_[i][d]);
      mean_stiff_[i][d] = 0;
    }
  }
  for (int s = 0; s < substeps_; ++s) {
    if (dipoles_) stiff_forces();
    for (int i = 0; i < n; ++i) {
      if (!carrier(i)) continue;
      const double mobility = mobility_[static_cast<std::size_t>(atom->type[i])];
      for (int d = 0; d < 3; ++d) {
        const double stiff = dipoles_ ? stiff_[i][d] : 0.0;
        x[i][d] += part * (v[i][d] + mobility * stiff);
        mean_stiff_[i][d] += part * stiff;
      }
    }
    if (s + 1 < substeps_) comm->forward_comm_fix(this);
  }
  for (int i = 0; i < n; ++i) {
    if (!carrier(i)) continue;
    const double mobility = mobility_[static_cast<std::size_t>(atom->type[i])];
    for (int d = 0; d < 3; ++d) v[i][d] += mobility * mean_stiff_[i][d];
  }
}

/// The fluid receives the mean of the stiff forces over the step with all the others.
void FixHemoDrag::post_force(int) {
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit)
      for (int d = 0; d < 3; ++d) atom->f[i][d] += mean_stiff_[i][d];
}

void FixHemoDrag::grow_arrays(int nmax) {
  memory->grow(mean_stiff_, nmax, 3, "hemo/drag:mean_stiff");
  memory->grow(stiff_, nmax, 3, "hemo/drag:stiff");
}

void FixHemoDrag::copy_arrays(int i, int j, int) { std::copy_n(mean_stiff_[i], 3, mean_stiff_[j]); }

void FixHemoDrag::set_arrays(int i) { std::fill_n(mean_stiff_[i], 3, 0.0); }

// The stiff force of the last step is part of f, and outlives a restart with its atom.
void FixHemoDrag::write_restart(FILE* file) {
  hemomag::lammps::write_state(file, comm->me, {started_ ? 1.0 : 0.0});
}

void FixHemoDrag::restart(char* buffer) {
  started_ = hemomag::lammps::StateReader(buffer).number() != 0;
}

int FixHemoDrag::pack_restart(int i, double* buffer) {
  buffer[0] = restart_width;
  std::copy_n(mean_stiff_[i], 3, buffer + 1);
  return restart_width;
}

/// An atom's stores of all fixes lie one after the other in atom->extra, each led by its length.
void FixHemoDrag::unpack_restart(int i, int nth) {
  const double* store = atom->extra[i];
  for (int k = 0; k < nth; ++k) store += static_cast<int>(*store);
  std::copy_n(store + 1, 3, mean_stiff_[i]);
}

int FixHemoDrag::pack_exchange(int i, double* buffer) {
  std::copy_n(mean_stiff_[i], 3, buffer);
  return 3;
}

int FixHemoDrag::unpack_exchange(int i, double* buffer) {
  std::copy_n(buffer, 3, mean_stiff_[i]);
  return 3;
}

// Only carriers travel: among the ghosts they are few.
int FixHemoDrag::pack_forward_comm(int n, int* list, double* buffer, int pbc_flag, int* pbc) {
  const double shift[3] = {pbc_flag ? pbc[0] * domain->xprd : 0.0,
                           pbc_flag ? pbc[1] * domain->yprd : 0.0,
                           pbc_flag ? pbc[2] * domain->zprd : 0.0};
  int m = 0;
  for (int k = 0; k < n; ++k)
    if (atom->mask[list[k]] & groupbit)
      for (int d = 0; d < 3; ++d) buffer[m++] = atom->x[list[k]][d] + shift[d];
  return m;
}

void FixHemoDrag::unpack_forward_comm(int n, int first, double* buffer) {
  for (int i = first; i < first + n; ++i)
    if (atom->mask[i] & groupbit)
      for (int d = 0; d < 3; ++d) atom->x[i][d] = *buffer++;
}

int FixHemoDrag::pack_reverse_comm(int n, int first, double* buffer) {
  int m = 0;
  for (int i = first; i < first + n; ++i)
    if (atom->mask[i] & groupbit)
      for (int d = 0; d < 3; ++d) buffer[m++] = stiff_[i][d];
  return m;
}

void FixHemoDrag::unpack_reverse_comm(int n, int* list, double* buffer) {
  for (int k = 0; k < n; ++k)
    if (atom->mask[list[k]] & groupbit)
      for (int d = 0; d < 3; ++d) stiff_[list[k]][d] += *buffer++;
}

double FixHemoDrag::memory_usage() { return 6.0 * sizeof(double) * atom->nmax; }
