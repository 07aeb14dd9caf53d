#include "lammps/fix_hemo_field.h"

#include <algorithm>
#include <string>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"
#include "update.h"
#include "utils.h"

#include "lammps/compat.hpp"
#include "magnetic/field_words.hpp"
#include "magnetic/moment.hpp"

using namespace LAMMPS_NS;
namespace magnetic = hemomag::magnetic;
using hemomag::Vec3;

FixHemoField::FixHemoField(LAMMPS* lmp, int narg, char** arg)
    : Fix(lmp, narg, arg), chi_volume_(static_cast<std::size_t>(atom->ntypes) + 1, 0.0) {
  scalar_flag = vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extscalar = extvector = 0;  // totals: not to be divided by the number of atoms
  comm_forward = 3;
  hemomag::lammps::or_fail(lmp, FLERR, [&] { parse({arg + 3, arg + narg}); });
  FixHemoField::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
}

FixHemoField::~FixHemoField() {
  atom->delete_callback(id, Atom::GROW);
  memory->destroy(moment_);
}

void FixHemoField::parse(const std::vector<std::string>& words) {
  for (std::size_t at = 0; at < words.size();)
    if (words[at] == "susceptibility")
      read_susceptibility(words, at);
    else
      try {
        magnetic::read_source(words, at, field_);
      } catch (const hemomag::Error& e) {
        throw hemomag::Error(std::string("fix hemo/field: ") + e.what());
      }
}

void FixHemoField::read_susceptibility(const std::vector<std::string>& words, std::size_t& at) {
  if (at + 2 >= words.size())
    throw hemomag::Error("fix hemo/field: susceptibility TYPE CHI_VC needs two values");
  const int type = utils::inumeric(FLERR, words[at + 1].c_str(), false, lmp);
  if (type < 1 || type > atom->ntypes)
    throw hemomag::Error(
        "fix hemo/field: susceptibility TYPE CHI_VC needs an atom type of the system");
  chi_volume_[static_cast<std::size_t>(type)] =
      utils::numeric(FLERR, words[at + 2].c_str(), false, lmp);
  at += 3;
}

int FixHemoField::setmask() { return FixConst::PRE_FORCE | FixConst::POST_FORCE; }

void FixHemoField::setup_pre_force(int vflag) { pre_force(vflag); }

void FixHemoField::setup(int vflag) { post_force(vflag); }

/// Moments of owned carriers (Eq. 22) and the force (m . grad) B on them (Eqs. 23, 41), at the time
/// of the step that is being made. Ghosts get their owner's moment: a field need not be periodic.
void FixHemoField::pre_force(int) {
  field_.set_time(static_cast<double>(update->ntimestep));
  const auto* x = reinterpret_cast<const Vec3*>(atom->x[0]);
  auto* m = reinterpret_cast<Vec3*>(moment_[0]);
  force_.assign(static_cast<std::size_t>(atom->nlocal), Vec3{});
  std::fill_n(sums_, 4, 0.0);
  for (int i = 0; i < atom->nlocal; ++i) {
    m[i] = Vec3{};
    if (!(atom->mask[i] & groupbit)) continue;
    const auto at = field_(x[i]);
    m[i] = magnetic::linear_moment(chi_volume_[static_cast<std::size_t>(atom->type[i])], at.B);
    const Vec3 F = magnetic::gradient_force(m[i], at);
    force_[static_cast<std::size_t>(i)] = F;
    sums_[0] += magnetic::induced_energy(m[i], at.B);
    for (std::size_t d = 0; d < 3; ++d) sums_[d + 1] += F[d];
  }
  comm->forward_comm_fix(this);
}

void FixHemoField::post_force(int) {
  auto* f = reinterpret_cast<Vec3*>(atom->f[0]);
  for (std::size_t i = 0; i < force_.size(); ++i) f[i] += force_[i];
}

double FixHemoField::compute_scalar() {
  double all = 0;
  MPI_Allreduce(&sums_[0], &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixHemoField::compute_vector(int d) {
  double all = 0;
  MPI_Allreduce(&sums_[d + 1], &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void FixHemoField::grow_arrays(int nmax) { memory->grow(moment_, nmax, 3, "hemo/field:moment"); }

void FixHemoField::copy_arrays(int i, int j, int) { std::copy_n(moment_[i], 3, moment_[j]); }

void FixHemoField::set_arrays(int i) { std::fill_n(moment_[i], 3, 0.0); }

int FixHemoField::pack_exchange(int i, double* buffer) {
  std::copy_n(moment_[i], 3, buffer);
  return 3;
}

int FixHemoField::unpack_exchange(int i, double* buffer) {
  std::copy_n(buffer, 3, moment_[i]);
  return 3;
}

int FixHemoField::pack_forward_comm(int n, int* list, double* buffer, int, int*) {
  int m = 0;
  for (int k = 0; k < n; ++k)
    if (atom->mask[list[k]] & groupbit)
      for (int d = 0; d < 3; ++d) buffer[m++] = moment_[list[k]][d];
  return m;
}

void FixHemoField::unpack_forward_comm(int n, int first, double* buffer) {
  for (int i = first; i < first + n; ++i)
    for (int d = 0; d < 3; ++d) moment_[i][d] = atom->mask[i] & groupbit ? *buffer++ : 0.0;
}

double FixHemoField::memory_usage() { return 3.0 * sizeof(double) * atom->nmax; }
