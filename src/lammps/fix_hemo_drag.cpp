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
    : Fix(lmp, narg, arg), kinds_(static_cast<std::size_t>(atom->ntypes) + 1) {
  time_integrate = 1;
  scalar_flag = 1;
  global_freq = 1;
  extscalar = 0;
  comm_forward = comm_reverse = 3;
  restart_global = restart_peratom = 1;
  for (int at = 3; at < narg;) {
    const std::string key = arg[at++];
    if ((key == "radius" || key == "inertia") && at + 1 < narg) {
      const int type = utils::inumeric(FLERR, arg[at++], false, lmp);
      const double value = utils::numeric(FLERR, arg[at++], false, lmp);
      if (type < 1 || type > atom->ntypes || !(value > 0))
        error->all(FLERR, "fix hemo/drag: " + key + (key == "radius" ? " TYPE A" : " TYPE M") +
                              " needs an atom type of the system and a value > 0");
      auto& kind = kinds_[static_cast<std::size_t>(type)];
      (key == "radius" ? kind.radius : kind.mass) = value;
    } else if (key == "feedback" && at < narg) {
      const std::string word = arg[at++];
      if (word != "yes" && word != "no")
        error->all(FLERR, "fix hemo/drag: feedback " + word + "; accepted: yes, no");
      feedback_ = word == "yes";
    } else {
      error->all(FLERR, "fix hemo/drag: " + key +
                            " is unknown or lacks values; accepted: radius TYPE A, "
                            "inertia TYPE M, feedback yes|no");
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
  memory->destroy(added_);
  memory->destroy(stiff_);
  memory->destroy(drift_);
}

int FixHemoDrag::setmask() { return FixConst::INITIAL_INTEGRATE | FixConst::POST_FORCE; }

void FixHemoDrag::init() {
  fluid_ = hemomag::lammps::find_fix<FixHemoFluid>(lmp, "hemo/fluid");
  if (!fluid_) error->all(FLERR, std::string("fix hemo/drag needs a fix hemo/fluid"));
  dipoles_ = dynamic_cast<PairHemoDipole*>(force->pair_match("hemo/dipole", 1));
  for (Kind& kind : kinds_) {
    if (kind.radius == 0) continue;
    kind.mobility = 1.0 / bare_friction(kind.radius);
    kind.relaxation_time = kind.mass * kind.mobility;
  }
  int without_radius = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if (carrier(i) && kind_of(i).radius == 0) without_radius = atom->type[i];
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

/// Chosen anew for every neighbour list, since moments grow as carriers approach a magnet. What is
/// stable without inertia is so with it.
void FixHemoDrag::choose_substeps() {
  if (!dipoles_ || chosen_at_ == neighbor->lastcall) return;
  chosen_at_ = neighbor->lastcall;
  double most_mobile = 0;
  for (const Kind& kind : kinds_) most_mobile = std::max(most_mobile, kind.mobility);
  const double stiffness = dipoles_->max_stiffness();
  const double needed = hemomag::magnetic::contact_substeps(stiffness * most_mobile);
  if (!(needed <= most_substeps))
    error->all(FLERR, "fix hemo/drag: step " + std::to_string(update->ntimestep) +
                          ": the contact forces need " + std::to_string(needed) +
                          " sub-steps, more than " + std::to_string(most_substeps) +
                          " (field too strong, or dt too long)");
  substeps_ = static_cast<int>(needed);
  if (substeps_ > most_reported_) {
    most_reported_ = substeps_;
    utils::logmesg(lmp, "fix hemo/drag: step " + std::to_string(update->ntimestep) + ": " +
                            std::to_string(substeps_) + " sub-steps for contacts of stiffness " +
                            std::to_string(stiffness) + "\n");
  }
}

bool FixHemoDrag::carrier(int i) const { return (atom->mask[i] & groupbit) != 0; }

const FixHemoDrag::Kind& FixHemoDrag::kind_of(int i) const {
  return kinds_[static_cast<std::size_t>(atom->type[i])];
}

void FixHemoDrag::stiff_forces() {
  const int all = atom->nlocal + atom->nghost;
  if (all > 0) std::fill_n(stiff_[0], 3 * all, 0.0);
  dipoles_->accumulate(atom->x, stiff_);
  comm->reverse_comm_fix(this);
}

long FixHemoDrag::pairs() { return dipoles_->pairs(); }

void FixHemoDrag::forward_positions() { comm->forward_comm_fix(this); }

void FixHemoDrag::setup(int vflag) {
  if (!started_ && dipoles_) {
    stiff_forces();
    for (int i = 0; i < atom->nlocal; ++i) std::copy_n(stiff_[i], 3, added_[i]);
  }
  started_ = true;
  post_force(vflag);
}

/// m du_b/dt = -Gamma (u_b - u_f) + F (Eqs. 33, 35), the stiff part of F renewed n_sub times a step
/// and every sub-step h solved exactly for a force that stands still: with w = u_f + F/Gamma, t_m =
/// m/Gamma and E = exp(-h/t_m) the velocity becomes w + (u_b - w) E, and the place moves by w h +
/// (u_b - w) t_m (1 - E). Without inertia, m = 0, this is u_b = w. Differs from the paper: explicit
/// Verlet is unstable at its parameters.
void FixHemoDrag::initial_integrate(int) {
  fluid_->velocity_at_atoms(groupbit, drift_);
  choose_substeps();
  double **x = atom->x, **v = atom->v, **f = atom->f;
  const double h = 1.0 / substeps_;
  const int n = atom->nlocal;
  for (int i = 0; i < n; ++i) {
    if (!carrier(i)) continue;
    const Kind& kind = kind_of(i);
    for (int d = 0; d < 3; ++d) {
      drift_[i][d] += kind.mobility * (f[i][d] - added_[i][d]);
      // The drag on the fluid is what is left of the forces when the carrier has taken its share.
      added_[i][d] = kind.mass * v[i][d];
    }
  }
  for (int s = 0; s < substeps_; ++s) {
    if (dipoles_) stiff_forces();
    for (int i = 0; i < n; ++i) {
      if (!carrier(i)) continue;
      const Kind& kind = kind_of(i);
      const double kept = kind.mass > 0 ? std::exp(-h / kind.relaxation_time) : 0;
      const double slip_time = kind.relaxation_time * (1 - kept);
      for (int d = 0; d < 3; ++d) {
        const double stiff = dipoles_ ? stiff_[i][d] : 0.0;
        const double w = drift_[i][d] + kind.mobility * stiff;
        const double slip = v[i][d] - w;
        x[i][d] += w * h + slip * slip_time;
        v[i][d] = w + slip * kept;
        added_[i][d] += h * stiff;
      }
    }
    if (s + 1 < substeps_) forward_positions();
  }
  for (int i = 0; i < n; ++i) {
    if (!carrier(i)) continue;
    const Kind& kind = kind_of(i);
    for (int d = 0; d < 3; ++d) {
      added_[i][d] -= kind.mass * v[i][d];
      // Without inertia the velocity is that of the whole step, not of its last part.
      if (kind.mass == 0) v[i][d] = drift_[i][d] + kind.mobility * added_[i][d];
    }
  }
}

/// The fluid receives the mean of the stiff forces over the step with all the others, less what
/// went into the carrier's own momentum.
void FixHemoDrag::post_force(int) {
  for (int i = 0; i < atom->nlocal; ++i)
    if (carrier(i))
      for (int d = 0; d < 3; ++d) atom->f[i][d] += added_[i][d];
}

void FixHemoDrag::grow_arrays(int nmax) {
  memory->grow(added_, nmax, 3, "hemo/drag:added");
  memory->grow(stiff_, nmax, 3, "hemo/drag:stiff");
  memory->grow(drift_, nmax, 3, "hemo/drag:drift");
}

void FixHemoDrag::copy_arrays(int i, int j, int) { std::copy_n(added_[i], 3, added_[j]); }

void FixHemoDrag::set_arrays(int i) { std::fill_n(added_[i], 3, 0.0); }

// What was added for the last step is part of f, and outlives a restart with its atom.
void FixHemoDrag::write_restart(FILE* file) {
  hemomag::lammps::write_state(file, comm->me, {started_ ? 1.0 : 0.0});
}

void FixHemoDrag::restart(char* buffer) {
  started_ = hemomag::lammps::StateReader(buffer).number() != 0;
}

int FixHemoDrag::pack_restart(int i, double* buffer) {
  buffer[0] = restart_width;
  std::copy_n(added_[i], 3, buffer + 1);
  return restart_width;
}

/// An atom's stores of all fixes lie one after the other in atom->extra, each led by its length.
void FixHemoDrag::unpack_restart(int i, int nth) {
  const double* store = atom->extra[i];
  for (int k = 0; k < nth; ++k) store += static_cast<int>(*store);
  std::copy_n(store + 1, 3, added_[i]);
}

int FixHemoDrag::pack_exchange(int i, double* buffer) {
  std::copy_n(added_[i], 3, buffer);
  return 3;
}

int FixHemoDrag::unpack_exchange(int i, double* buffer) {
  std::copy_n(buffer, 3, added_[i]);
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

double FixHemoDrag::memory_usage() { return 9.0 * sizeof(double) * atom->nmax; }
