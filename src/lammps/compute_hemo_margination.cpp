#include "lammps/compute_hemo_margination.h"

#include <algorithm>
#include <limits>
#include <string>

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "update.h"
#include "utils.h"

#include "lammps/compat.hpp"
#include "lammps/fix_hemo_fluid.h"
#include "solver/fluid_solver.hpp"

using namespace LAMMPS_NS;
namespace analysis = hemomag::analysis;

ComputeHemoMargination::ComputeHemoMargination(LAMMPS* lmp, int narg, char** arg)
    : Compute(lmp, narg, arg) {
  vector_flag = 1;
  size_vector = 3;
  extvector = 0;
  vector = new double[3]();
  for (int at = 3; at + 1 < narg; at += 2) {
    const std::string key = arg[at], value = arg[at + 1];
    if (key == "layer")
      layer_ = utils::numeric(FLERR, value.c_str(), false, lmp);
    else if (key == "walls" && (value == "lower" || value == "vessel"))
      walls_ = analysis::LayerWalls::lower, in_vessel_ = value == "vessel";
    else if (key == "walls" && value == "both")
      walls_ = analysis::LayerWalls::both, in_vessel_ = false;
    else
      error->all(FLERR, "compute hemo/margination: " + key + " " + value +
                            "; accepted: layer L, walls lower|both|vessel");
  }
  if (!(layer_ > 0))
    error->all(FLERR, std::string("compute hemo/margination needs layer L with L > 0"));
}

ComputeHemoMargination::~ComputeHemoMargination() { delete[] vector; }

void ComputeHemoMargination::init() {
  if (!in_vessel_) return;
  fluid_ = hemomag::lammps::find_fix<FixHemoFluid>(lmp, "hemo/fluid");
  if (!fluid_)
    error->all(FLERR, std::string("compute hemo/margination: walls vessel needs a fix hemo/fluid"));
}

double ComputeHemoMargination::height(int i) const {
  if (in_vessel_)
    return fluid_->solver().wall_distance({atom->x[i][0], atom->x[i][1], atom->x[i][2]}).distance;
  if (atom->molecule[i] == 0) return atom->x[i][2];
  double unwrapped[3];
  domain->unmap(atom->x[i], atom->image[i], unwrapped);
  return unwrapped[2];
}

/// Heights of this rank's free particles, and on rank 0 also of all worms, the mean over their
/// beads: that of the centre between plates; in a vessel the mean distance from the wall.
std::vector<double> ComputeHemoMargination::heights() const {
  std::vector<double> z;
  tagint lo = std::numeric_limits<tagint>::max(), hi = 0, range[2], all[2];
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (atom->molecule[i] == 0) {
      z.push_back(height(i));
    } else {
      lo = std::min(lo, atom->molecule[i]);
      hi = std::max(hi, atom->molecule[i]);
    }
  }
  range[0] = -lo;
  range[1] = hi;
  MPI_Allreduce(range, all, 2, MPI_LMP_TAGINT, MPI_MAX, world);
  lo = -all[0], hi = all[1];
  if (hi == 0) return z;
  std::vector<double> sum(2 * static_cast<std::size_t>(hi - lo + 1), 0.0), total(sum.size());
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit) || atom->molecule[i] == 0) continue;
    const auto worm = 2 * static_cast<std::size_t>(atom->molecule[i] - lo);
    sum[worm] += height(i);
    sum[worm + 1] += 1;
  }
  MPI_Reduce(sum.data(), total.data(), static_cast<int>(sum.size()), MPI_DOUBLE, MPI_SUM, 0, world);
  int me = 0;
  MPI_Comm_rank(world, &me);
  if (me == 0)
    for (std::size_t worm = 0; worm < total.size(); worm += 2)
      if (total[worm + 1] > 0) z.push_back(total[worm] / total[worm + 1]);
  return z;
}

void ComputeHemoMargination::compute_vector() {
  invoked_vector = update->ntimestep;
  if (in_vessel_ && !fluid_->solver().has_vessel())
    error->all(FLERR, std::string("compute hemo/margination: walls vessel needs a fluid with tube "
                                  "or surface"));
  const auto z = heights();
  const double top = domain->boxhi[2] - domain->boxlo[2];
  long mine[2] = {analysis::in_layer(z, layer_, top, walls_), static_cast<long>(z.size())}, all[2];
  MPI_Allreduce(mine, all, 2, MPI_LONG, MPI_SUM, world);
  if (at_start_ < 0) at_start_ = all[0];
  vector[0] = static_cast<double>(all[0]);
  vector[1] = analysis::margination_probability(all[0], at_start_, all[1]);
  vector[2] = static_cast<double>(all[1]);
}
