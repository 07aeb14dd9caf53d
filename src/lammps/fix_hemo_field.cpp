#include "lammps/fix_hemo_field.h"

#include <algorithm>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "memory.h"
#include "update.h"
#include "utils.h"

#include "io/field_table_file.hpp"
#include "lammps/compat.hpp"
#include "magnetic/clearance.hpp"
#include "magnetic/field_words.hpp"

using namespace LAMMPS_NS;
namespace magnetic = hemomag::magnetic;
using hemomag::Vec3;

FixHemoField::FixHemoField(LAMMPS* lmp, int narg, char** arg)
    : Fix(lmp, narg, arg), magnetisation_(static_cast<std::size_t>(atom->ntypes) + 1) {
  scalar_flag = vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extscalar = extvector = 0;  // totals: not to be divided by the number of atoms
  comm_forward = 3;
  hemomag::lammps::or_fail(lmp, FLERR, [&] {
    try {
      parse({arg + 3, arg + narg});
    } catch (const hemomag::Error& e) {
      throw hemomag::Error(std::string("fix hemo/field: ") + e.what());
    }
  });
  FixHemoField::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
}

FixHemoField::~FixHemoField() {
  atom->delete_callback(id, Atom::GROW);
  memory->destroy(moment_);
}

void FixHemoField::parse(const std::vector<std::string>& words) {
  const auto read_table = [](const std::string& file) {
    return std::make_shared<const hemomag::lattice::FieldTable>(
        hemomag::io::read_field_table(file));
  };
  for (std::size_t at = 0; at < words.size();) {
    const bool slope = words[at] == "susceptibility";
    if (!slope && words[at] != "saturation") {
      magnetic::read_source(words, at, field_, read_table);
      continue;
    }
    if (at + 2 >= words.size()) throw hemomag::Error(words[at] + " TYPE VALUE needs two values");
    const double value = utils::numeric(FLERR, words[at + 2].c_str(), false, lmp);
    auto& law = of_type(words[at + 1]);
    (slope ? law.chi_volume : law.saturation) = value;
    at += 3;
  }
  for (const auto& law : magnetisation_)
    if (law.saturation < 0 || (law.saturation > 0 && law.chi_volume < 0))
      throw hemomag::Error("saturation needs a positive moment and a susceptibility that is not "
                           "negative");
}

magnetic::Magnetisation& FixHemoField::of_type(const std::string& word) {
  const int type = utils::inumeric(FLERR, word.c_str(), false, lmp);
  if (type < 1 || type > atom->ntypes)
    throw hemomag::Error("atom type " + word + " is not one of the system");
  return magnetisation_[static_cast<std::size_t>(type)];
}

/// Carriers go everywhere in the box: no matter of a source may be there, and no table end.
void FixHemoField::init() {
  const Vec3 low{domain->boxlo[0], domain->boxlo[1], domain->boxlo[2]};
  const Vec3 high{domain->boxhi[0], domain->boxhi[1], domain->boxhi[2]};
  for (const auto& source : field_.sources()) {
    const auto gap = magnetic::gap(source.shape, low, high);
    if (gap && gap->distance < magnetic::least_gap)
      error->all(FLERR, std::string("fix hemo/field: a magnet, coil or wire reaches into the box"));
    if (!magnetic::covers(source.shape, low, high))
      error->all(FLERR, std::string("fix hemo/field: a table ends inside the box"));
  }
}

int FixHemoField::setmask() { return FixConst::PRE_FORCE | FixConst::POST_FORCE; }

void FixHemoField::setup_pre_force(int vflag) { pre_force(vflag); }

void FixHemoField::setup(int vflag) { post_force(vflag); }

/// Moments of owned carriers (Eq. 22, or saturating) and the force (m . grad) B on them (Eqs. 23,
/// 41), at the time of the step that is being made. Ghosts get their owner's moment: a field need
/// not be periodic.
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
    const auto& law = magnetisation_[static_cast<std::size_t>(atom->type[i])];
    m[i] = law.moment(at.B);
    const Vec3 F = magnetic::gradient_force(m[i], at);
    force_[static_cast<std::size_t>(i)] = F;
    sums_[0] += law.energy(at.B);
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
