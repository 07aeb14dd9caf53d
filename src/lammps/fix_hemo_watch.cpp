#include "lammps/fix_hemo_watch.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "update.h"
#include "utils.h"

#include "analysis/inside.hpp"
#include "lammps/angle_hemo_membrane.h"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_fluid.h"
#include "solver/fluid_solver.hpp"

using namespace LAMMPS_NS;
namespace analysis = hemomag::analysis;
using hemomag::Vec3;

FixHemoWatch::FixHemoWatch(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  if (narg < 4)
    error->all(FLERR,
               std::string("fix hemo/watch needs N [mach_max M] [cells GROUP] [carriers GROUP]"));
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  if (nevery <= 0) error->all(FLERR, std::string("fix hemo/watch: N must be > 0"));
  for (int at = 4; at + 1 < narg; at += 2) {
    const std::string key = arg[at];
    if (key == "mach_max")
      mach_limit_ = utils::numeric(FLERR, arg[at + 1], false, lmp);
    else if (key == "cells")
      cell_bits_ = group_bit(arg[at + 1]);
    else if (key == "carriers")
      carrier_bits_ = group_bit(arg[at + 1]);
    else
      error->all(FLERR,
                 "fix hemo/watch: " + key + " is unknown; accepted: mach_max, cells, carriers");
  }
  vector_flag = 1;
  size_vector = 6;
  global_freq = nevery;
  extvector = 0;
}

int FixHemoWatch::group_bit(const char* name) {
  const int found = group->find(name);
  if (found < 0) error->all(FLERR, std::string("fix hemo/watch: there is no group ") + name);
  return group->bitmask[found];
}

int FixHemoWatch::setmask() { return FixConst::END_OF_STEP | FixConst::POST_RUN; }

void FixHemoWatch::init() {
  fluid_ = hemomag::lammps::find_fix<FixHemoFluid>(lmp, "hemo/fluid");
  membrane_ = dynamic_cast<AngleHemoMembrane*>(force->angle_match("hemo/membrane"));
}

void FixHemoWatch::setup(int) { look(); }
void FixHemoWatch::end_of_step() { look(); }
void FixHemoWatch::post_run() {
  if (last_ != update->ntimestep) look();
}

void FixHemoWatch::look() {
  last_ = update->ntimestep;
  check_finite();
  if (fluid_) check_mach();
  check_counts(!started_);
  if (membrane_) check_cells();
  if (membrane_ && carrier_bits_) count_inside();
  started_ = true;
}

void FixHemoWatch::violation(const std::string& what) const {
  error->all(FLERR, "fix hemo/watch: step " + std::to_string(update->ntimestep) + ": " + what);
}

void FixHemoWatch::check_finite() {
  tagint mine = 0, found = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    for (int d = 0; d < 3; ++d)
      if (!std::isfinite(atom->x[i][d] + atom->v[i][d] + atom->f[i][d]))
        mine = std::max(mine, atom->tag[i]);
  MPI_Allreduce(&mine, &found, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (found > 0)
    violation(
        "position, velocity or force of atom " + std::to_string(found) +
        " is not finite (the run is unstable: a shorter time step or weaker forces may help)");
}

void FixHemoWatch::check_mach() {
  // A NaN fails the comparison and is reported like a speed that is too high.
  const double speed = fluid_->solver().max_speed();
  double mine = std::isfinite(speed) ? speed : HUGE_VAL, all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, world);
  const double mach = all * std::sqrt(3.0);
  record_.mach_max = std::max(record_.mach_max, mach);
  if (mach > mach_limit_)
    violation("the fluid's Mach number is " + std::to_string(mach) + ", the limit is " +
              std::to_string(mach_limit_) +
              " (flow too fast, or forces too strong, for the time step)");
}

bigint FixHemoWatch::count(int bits) const {
  bigint mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal; ++i) mine += (atom->mask[i] & bits) != 0;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

void FixHemoWatch::check_counts(bool first) {
  const bigint carriers = carrier_bits_ ? count(carrier_bits_) : 0;
  const bigint cell_atoms = cell_bits_ ? count(cell_bits_) : 0;
  bigint mine = 0, cells = 0;
  if (membrane_)
    for (const auto& cell : membrane_->cells()) mine += cell.mine;
  MPI_Allreduce(&mine, &cells, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (first) {
    record_.carriers_start = carriers;
    record_.cells_start = cells;
    cell_atoms_ = cell_atoms;
  }
  record_.carriers_end = carriers;
  record_.cells_end = cells;
  if (carriers != record_.carriers_start)
    violation("there are " + std::to_string(carriers) + " carriers, the run began with " +
              std::to_string(record_.carriers_start) + " (they left through a wall)");
  if (cells != record_.cells_start || cell_atoms != cell_atoms_)
    violation("there are " + std::to_string(cells) + " cells of " + std::to_string(cell_atoms) +
              " vertices, the run began with " + std::to_string(record_.cells_start) + " of " +
              std::to_string(cell_atoms_));
}

void FixHemoWatch::check_cells() {
  double mine[2] = {0, 0}, all[2];
  for (const auto& cell : membrane_->cells()) {
    mine[0] = std::max(mine[0], std::fabs(cell.area / cell.area0 - 1));
    mine[1] = std::max(mine[1], std::fabs(cell.volume / cell.volume0 - 1));
  }
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_MAX, world);
  record_.area_drift_max = std::max(record_.area_drift_max, all[0]);
  record_.volume_drift_max = std::max(record_.volume_drift_max, all[1]);
  if (all[1] > 0.5)
    violation("a cell's volume differs from its rest volume by " + std::to_string(100 * all[1]) +
              " % (a cell turned inside out or burst)");
}

/// Every rank learns all carriers, counts crossings with its own triangles, and the counts are
/// summed.
void FixHemoWatch::count_inside() {
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & carrier_bits_) mine.insert(mine.end(), atom->x[i], atom->x[i] + 3);
  std::vector<int> counts(static_cast<std::size_t>(comm->nprocs)), starts(counts.size(), 0);
  const int n = static_cast<int>(mine.size());
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<Vec3> carriers(static_cast<std::size_t>(starts.back() + counts.back()) / 3);
  if (carriers.empty()) return;
  MPI_Allgatherv(mine.data(), n, MPI_DOUBLE, &carriers[0].x, counts.data(), starts.data(),
                 MPI_DOUBLE, world);

  const auto surface = membrane_->surface();
  const analysis::ChannelBox box{{domain->xprd, domain->yprd, domain->zprd},
                                 domain->zperiodic != 0};
  auto times = analysis::enclosure(carriers, surface.triangles, box);
  MPI_Allreduce(MPI_IN_PLACE, times.data(), static_cast<int>(times.size()), MPI_INT, MPI_SUM,
                world);
  const auto inside = std::count_if(times.begin(), times.end(), [](int t) { return t != 0; });
  record_.carriers_inside_max = std::max(record_.carriers_inside_max, static_cast<bigint>(inside));
}

/// 1 cells, 2 carriers, 3 most carriers inside cells, 4 largest Mach number, 5 area drift, 6 volume
/// drift.
double FixHemoWatch::compute_vector(int k) {
  const double values[] = {static_cast<double>(record_.cells_end),
                           static_cast<double>(record_.carriers_end),
                           static_cast<double>(record_.carriers_inside_max),
                           record_.mach_max,
                           record_.area_drift_max,
                           record_.volume_drift_max};
  return values[k];
}
