#include "lammps/fix_hemo_field.h"

#include <algorithm>
#include <string>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"
#include "utils.h"

#include "lammps/compat.hpp"
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
  for (int at = 3; at < narg;) {
    const std::string key = arg[at];
    if (key == "susceptibility" && at + 2 < narg) {
      const int type = utils::inumeric(FLERR, arg[at + 1], false, lmp);
      if (type < 1 || type > atom->ntypes)
        error->all(
            FLERR,
            std::string(
                "fix hemo/field: susceptibility TYPE CHI_VC needs an atom type of the system"));
      chi_volume_[static_cast<std::size_t>(type)] = utils::numeric(FLERR, arg[at + 2], false, lmp);
      at += 3;
    } else {
      at = parse_field(narg, arg, at);
    }
  }
  FixHemoField::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
}

FixHemoField::~FixHemoField() {
  atom->delete_callback(id, Atom::GROW);
  memory->destroy(moment_);
}

int FixHemoField::parse_field(int narg, char** arg, int at) {
  const std::string kind = arg[at++];
  const auto number = [&] {
    if (at >= narg) error->all(FLERR, "fix hemo/field: " + kind + " needs more values");
    return utils::numeric(FLERR, arg[at++], false, lmp);
  };
  if (kind == "none") {
    field_ = magnetic::NoField{};
  } else if (kind == "uniform") {
    const double x = number(), y = number(), z = number();
    field_ = magnetic::UniformField{{x, y, z}};
  } else if (kind == "gradient") {
    const std::string axis = at < narg ? arg[at++] : "";
    if (axis != "x" && axis != "y" && axis != "z")
      error->all(FLERR,
                 std::string("fix hemo/field: gradient AXIS SLOPE ZERO needs an axis x, y or z"));
    const double slope = number(), zero = number();
    field_ = magnetic::AxialGradient{axis[0] - 'x', slope, zero};
  } else {
    error->all(FLERR, "fix hemo/field: " + kind +
                          " is unknown; accepted: susceptibility TYPE CHI_VC, none, "
                          "uniform BX BY BZ, gradient AXIS SLOPE ZERO");
  }
  return at;
}

int FixHemoField::setmask() { return FixConst::PRE_FORCE | FixConst::POST_FORCE; }

void FixHemoField::setup_pre_force(int vflag) { pre_force(vflag); }

void FixHemoField::setup(int vflag) { post_force(vflag); }

/// Moments of owned carriers (Eq. 22). Ghosts get their owner's: a field need not be periodic.
void FixHemoField::pre_force(int) {
  const auto* x = reinterpret_cast<const Vec3*>(atom->x[0]);
  auto* m = reinterpret_cast<Vec3*>(moment_[0]);
  for (int i = 0; i < atom->nlocal; ++i)
    m[i] = atom->mask[i] & groupbit
               ? magnetic::linear_moment(chi_volume_[static_cast<std::size_t>(atom->type[i])],
                                         magnetic::evaluate(field_, x[i]).B)
               : Vec3{};
  comm->forward_comm_fix(this);
}

/// (m . grad) B on owned carriers (Eqs. 23, 41).
void FixHemoField::post_force(int) {
  const auto* x = reinterpret_cast<const Vec3*>(atom->x[0]);
  const auto* m = reinterpret_cast<const Vec3*>(moment_[0]);
  auto* f = reinterpret_cast<Vec3*>(atom->f[0]);
  std::fill_n(sums_, 4, 0.0);
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const auto at = magnetic::evaluate(field_, x[i]);
    const Vec3 F = magnetic::gradient_force(m[i], at);
    f[i] += F;
    sums_[0] += magnetic::induced_energy(m[i], at.B);
    for (std::size_t d = 0; d < 3; ++d) sums_[d + 1] += F[d];
  }
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
