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
#include "input.h"
#include "update.h"
#include "utils.h"

#include "analysis/inside.hpp"
#include "lammps/angle_hemo_membrane.h"
#include "lammps/bond_hemo_wlc.h"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_fluid.h"
#include "lammps/fix_state.hpp"
#include "solver/fluid_solver.hpp"

using namespace LAMMPS_NS;
namespace analysis = hemomag::analysis;
using hemomag::Vec3;

namespace {

/// The largest value of all ranks, and whose it is. Collective.
struct Extreme {
  double value;
  int rank;
  Extreme(MPI_Comm world, int me, double mine) {
    // A NaN compares with nothing: it must not get lost in the reduction.
    struct {
      double value;
      int rank;
    } in{std::isnan(mine) ? HUGE_VAL : mine, me}, out{};
    MPI_Allreduce(&in, &out, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
    value = out.value, rank = out.rank;
  }
};

constexpr double worst_volume_drift = 0.5;

std::string three(const double* v) {
  return std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]);
}

}  // namespace

FixHemoWatch::FixHemoWatch(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  if (narg < 4)
    error->all(FLERR, std::string("fix hemo/watch needs N [mach_max M] [displacement_max D] "
                                  "[cells GROUP] [carriers GROUP] [inside_looks K] "
                                  "[inspection DIR DX_UM DT_S]"));
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  if (nevery <= 0) error->all(FLERR, std::string("fix hemo/watch: N must be > 0"));
  for (int at = 4; at + 1 < narg; at += 2) {
    const std::string key = arg[at];
    if (key == "mach_max")
      mach_limit_ = utils::numeric(FLERR, arg[at + 1], false, lmp);
    else if (key == "displacement_max")
      displacement_limit_ = utils::numeric(FLERR, arg[at + 1], false, lmp);
    else if (key == "cells")
      cell_bits_ = group_bit(arg[at + 1]);
    else if (key == "carriers")
      carrier_bits_ = group_bit(arg[at + 1]);
    else if (key == "inside_looks")
      looks_inside_ = utils::inumeric(FLERR, arg[at + 1], false, lmp);
    else if (key == "inspection" && at + 3 < narg)
      inspection_ = std::string(arg[at + 1]) + " dx_um " + arg[at + 2] + " dt_s " + arg[at + 3],
      at += 2;
    else
      error->all(FLERR, "fix hemo/watch: " + key +
                            " is unknown; accepted: mach_max, displacement_max, cells, carriers, "
                            "inside_looks, inspection DIR DX_UM DT_S");
  }
  vector_flag = restart_global = 1;
  size_vector = 8;
  global_freq = nevery;
  extvector = 0;
}

int FixHemoWatch::group_bit(const char* name) {
  const int found = group->find(name);
  if (found < 0) error->all(FLERR, std::string("fix hemo/watch: there is no group ") + name);
  return group->bitmask[found];
}

int FixHemoWatch::setmask() {
  return FixConst::POST_INTEGRATE | FixConst::FINAL_INTEGRATE | FixConst::END_OF_STEP |
         FixConst::POST_RUN;
}

void FixHemoWatch::init() {
  fluid_ = hemomag::lammps::find_fix<FixHemoFluid>(lmp, "hemo/fluid");
  membrane_ = dynamic_cast<AngleHemoMembrane*>(force->angle_match("hemo/membrane"));
  springs_ = dynamic_cast<BondHemoWLC*>(force->bond_match("hemo/wlc"));
}

void FixHemoWatch::setup(int) {
  // After a restart the step has been looked at, or will be in its turn: what is recorded does not
  // depend on when checkpoints were written.
  if (!resumed_) look();
  resumed_ = false;
}

// What has no force or no place in the lists of LAMMPS must be found before it computes these.
void FixHemoWatch::post_integrate() {
  const double start = MPI_Wtime();
  check_plates();
  check_motion();
  check_accidents();
  record_.seconds += MPI_Wtime() - start;
}

void FixHemoWatch::final_integrate() {
  const double start = MPI_Wtime();
  check_accidents();
  record_.seconds += MPI_Wtime() - start;
}
void FixHemoWatch::end_of_step() { look(); }
void FixHemoWatch::post_run() {
  if (last_ != update->ntimestep && update->ntimestep == update->laststep) look();
}

void FixHemoWatch::look() {
  const double start = MPI_Wtime();
  const Seen seen = inspect();
  last_ = update->ntimestep;
  if (!started_) {
    record_.carriers_start = seen.carriers;
    record_.cells_start = seen.cells;
    cell_atoms_ = seen.cell_atoms;
    started_ = true;
  }
  auto& r = record_;
  r.carriers_end = seen.carriers;
  r.cells_end = seen.cells;
  r.mach_max = std::max(r.mach_max, seen.mach);
  r.displacement_max = std::max(r.displacement_max, seen.displacement);
  r.stretch_max = std::max(r.stretch_max, seen.stretch);
  r.area_drift_max = std::max(r.area_drift_max, seen.area_drift);
  r.volume_drift_max = std::max(r.volume_drift_max, seen.volume_drift);
  if (membrane_ && carrier_bits_) count_inside();
  r.seconds += MPI_Wtime() - start;
}

void FixHemoWatch::verify() {
  if (last_ != update->ntimestep) inspect();
}

/// Every check. Ends the run at the first that fails.
FixHemoWatch::Seen FixHemoWatch::inspect() {
  Seen seen;
  check_accidents();
  check_finite();
  seen.displacement = check_displacement();
  if (fluid_) seen.mach = check_mach();
  check_counts(seen);
  if (springs_) seen.stretch = check_stretch();
  if (membrane_) check_cells(seen);
  return seen;
}

/// Ends the run on every rank, with what one of them has to say. The state is written first.
void FixHemoWatch::violation(int rank, const std::string& what) {
  std::string said = what;
  int length = static_cast<int>(said.size());
  MPI_Bcast(&length, 1, MPI_INT, rank, world);
  said.resize(static_cast<std::size_t>(length));
  MPI_Bcast(said.data(), length, MPI_CHAR, rank, world);
  const std::string where = "fix hemo/watch: step " + std::to_string(update->ntimestep) +
                            ", rank " + std::to_string(rank);
  if (!inspection_.empty()) {
    // A fix of its own: it writes as it is set up, and goes with the run.
    hemomag::lammps::ending().reason = where + ": " + said;
    input->one("fix hemo_watch_inspection all hemo/snapshot 1000000000 " + inspection_);
    auto* snapshot = lmp->modify->fix[lmp->modify->nfix - 1];
    snapshot->init();
    snapshot->setup(0);
  }
  error->all(FLERR, where + ": " + said);
}

/// "atom 17 of cell 3", "carrier 40".
std::string FixHemoWatch::name_of(int i) const {
  const std::string tag = std::to_string(atom->tag[i]);
  const tagint molecule = atom->molecule ? atom->molecule[i] : 0;
  if (carrier_bits_ & atom->mask[i])
    return "carrier " + tag + (molecule > 0 ? " of worm " + std::to_string(molecule) : "");
  return "atom " + tag + (molecule > 0 ? " of cell " + std::to_string(molecule) : "");
}

void FixHemoWatch::note(const std::string& accident) {
  if (accident_.empty()) accident_ = accident;
}

/// In every step: does an atom of this rank stand beyond a plate, or nowhere?
void FixHemoWatch::check_plates() {
  for (int d = 0; d < 3; ++d) {
    if (domain->periodicity[d]) continue;
    const double low = domain->boxlo[d], high = domain->boxhi[d];
    for (int i = 0; i < atom->nlocal; ++i) {
      const double* x = atom->x[i];
      if (x[d] > low && x[d] < high) continue;
      note(name_of(i) + " at " + three(x) +
           " is beyond a plate, or not finite (forces too strong for the time step: a smaller one, "
           "numerics.dt or cell_reynolds, may help)");
      return;
    }
  }
}

/// In every step: does an atom of this rank move farther than LAMMPS can follow it? Velocities are
/// displacements in a step.
void FixHemoWatch::check_motion() {
  const double limit2 = displacement_limit_ * displacement_limit_;
  for (int i = 0; i < atom->nlocal; ++i) {
    const double* v = atom->v[i];
    const double step2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (step2 <= limit2) continue;
    note(too_fast(i));
    return;
  }
}

/// What is said of an atom whose displacement is beyond the limit, or not finite.
std::string FixHemoWatch::too_fast(int i) const {
  const double* v = atom->v[i];
  return name_of(i) + " at " + three(atom->x[i]) + " moves " +
         std::to_string(std::hypot(v[0], v[1], v[2])) + " nodes in a step, the limit is " +
         std::to_string(displacement_limit_) +
         " (forces too strong for the time step: a smaller one, numerics.dt or cell_reynolds, may "
         "help)";
}

void FixHemoWatch::check_accidents() {
  const Extreme worst(world, comm->me, accident_.empty() ? 0.0 : 1.0);
  if (worst.value > 0) violation(worst.rank, accident_);
}

void FixHemoWatch::check_finite() {
  int mine = -1;
  for (int i = 0; i < atom->nlocal && mine < 0; ++i)
    for (int d = 0; d < 3; ++d)
      if (!std::isfinite(atom->x[i][d] + atom->v[i][d] + atom->f[i][d])) mine = i;
  const Extreme worst(world, comm->me, mine < 0 ? 0.0 : 1.0);
  if (worst.value == 0) return;
  std::string what;
  if (comm->me == worst.rank) {
    what = name_of(mine) + ": position " + three(atom->x[mine]) + ", velocity " +
           three(atom->v[mine]) + ", force " + three(atom->f[mine]) +
           " are not all finite (the run is unstable: a shorter time step or weaker forces may "
           "help)";
  }
  violation(worst.rank, what);
}

double FixHemoWatch::check_displacement() {
  double most = 0;
  int at = -1;
  for (int i = 0; i < atom->nlocal; ++i) {
    const double* v = atom->v[i];
    const double step2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (step2 <= most) continue;
    most = step2;
    at = i;
  }
  const Extreme worst(world, comm->me, std::sqrt(most));
  if (worst.value > displacement_limit_)
    violation(worst.rank, comm->me == worst.rank ? too_fast(at) : "");
  return worst.value;
}

double FixHemoWatch::check_mach() {
  // Populations that are not finite give a velocity that is not.
  const auto mine = fluid_->solver().fastest();
  const Extreme worst(world, comm->me, mine.speed * std::sqrt(3.0));
  if (!(worst.value <= mach_limit_))
    violation(worst.rank, "the fluid's Mach number is " + std::to_string(worst.value) +
                              " at the node " + std::to_string(mine.node[0]) + " " +
                              std::to_string(mine.node[1]) + " " + std::to_string(mine.node[2]) +
                              ", the limit is " + std::to_string(mach_limit_) +
                              " (flow too fast, or forces too strong, for the time step)");
  return worst.value;
}

bigint FixHemoWatch::count(int bits) const {
  bigint mine = 0, all = 0;
  for (int i = 0; i < atom->nlocal; ++i) mine += (atom->mask[i] & bits) != 0;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

void FixHemoWatch::check_counts(Seen& seen) {
  seen.carriers = carrier_bits_ ? count(carrier_bits_) : 0;
  seen.cell_atoms = cell_bits_ ? count(cell_bits_) : 0;
  bigint mine = 0;
  if (membrane_)
    for (const auto& cell : membrane_->cells()) mine += cell.mine;
  MPI_Allreduce(&mine, &seen.cells, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (!started_) return;
  if (seen.carriers != record_.carriers_start)
    violation(0, "there are " + std::to_string(seen.carriers) + " carriers, the run began with " +
                     std::to_string(record_.carriers_start) + " (they left through a wall)");
  if (seen.cells != record_.cells_start || seen.cell_atoms != cell_atoms_)
    violation(0, "there are " + std::to_string(seen.cells) + " cells of " +
                     std::to_string(seen.cell_atoms) + " vertices, the run began with " +
                     std::to_string(record_.cells_start) + " of " + std::to_string(cell_atoms_) +
                     " (vertices left through a wall)");
}

/// The spring itself ends the run in the step in which an edge reaches its greatest length, which
/// is before any look; what is seen here is how near the edges come to it.
double FixHemoWatch::check_stretch() {
  return Extreme(world, comm->me, springs_->greatest_stretch()).value;
}

void FixHemoWatch::check_cells(Seen& seen) {
  double area = 0, volume = 0;
  const AngleHemoMembrane::CellState* at = nullptr;
  for (const auto& cell : membrane_->cells()) {
    area = std::max(area, std::fabs(cell.area / cell.area0 - 1));
    const double drift = std::fabs(cell.volume / cell.volume0 - 1);
    if (at && !(drift > volume)) continue;
    volume = drift;
    at = &cell;
  }
  seen.area_drift = Extreme(world, comm->me, area).value;
  const Extreme worst(world, comm->me, volume);
  seen.volume_drift = worst.value;
  if (!(worst.value <= worst_volume_drift))
    violation(worst.rank, comm->me == worst.rank
                              ? "cell " + std::to_string(at->molecule) + " encloses the volume " +
                                    std::to_string(at->volume) + ", its rest volume is " +
                                    std::to_string(at->volume0) +
                                    " (it turned inside out or burst: forces too strong, or the "
                                    "time step too long)"
                              : "");
}

/// Every rank learns all carriers, counts crossings with its own triangles, and the counts are
/// summed.
void FixHemoWatch::count_inside() {
  struct Place {
    Vec3 x;
    double tag;
  };
  constexpr int width = sizeof(Place) / sizeof(double);
  std::vector<Place> mine;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & carrier_bits_)
      mine.push_back(
          {{atom->x[i][0], atom->x[i][1], atom->x[i][2]}, static_cast<double>(atom->tag[i])});
  std::vector<int> counts(static_cast<std::size_t>(comm->nprocs)), starts(counts.size(), 0);
  const int n = width * static_cast<int>(mine.size());
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<Place> all(static_cast<std::size_t>((starts.back() + counts.back()) / width));
  if (all.empty()) return;
  MPI_Allgatherv(mine.data(), n, MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE,
                 world);
  std::vector<Vec3> carriers;
  carriers.reserve(all.size());
  for (const Place& carrier : all) carriers.push_back(carrier.x);

  const auto surface = membrane_->surface();
  const analysis::ChannelBox box{{domain->xprd, domain->yprd, domain->zprd},
                                 domain->zperiodic != 0};
  auto times = analysis::enclosure(carriers, surface.triangles, box);
  MPI_Allreduce(MPI_IN_PLACE, times.data(), static_cast<int>(times.size()), MPI_INT, MPI_SUM,
                world);
  std::map<tagint, int> looks;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (times[k] != 0) {
      const auto tag = static_cast<tagint>(all[k].tag);
      looks[tag] = inside_[tag] + 1;
    }
  inside_ = std::move(looks);
  record_.carriers_inside_max =
      std::max(record_.carriers_inside_max, static_cast<bigint>(inside_.size()));
  for (const auto& [tag, seen] : inside_)
    if (looks_inside_ > 0 && seen >= looks_inside_)
      violation(0, "carrier " + std::to_string(tag) + " has been inside a cell for " +
                       std::to_string(seen) +
                       " looks (pulled through the membrane: a weaker field, a finer mesh or a "
                       "larger contact.carrier_sigma may help)");
}

/// 1 cells, 2 carriers, 3 most carriers inside cells, 4 largest Mach number, 5 area drift, 6 volume
/// drift, 7 displacement in a step, 8 edge length over its limit.
double FixHemoWatch::compute_vector(int k) {
  const double values[] = {static_cast<double>(record_.cells_end),
                           static_cast<double>(record_.carriers_end),
                           static_cast<double>(record_.carriers_inside_max),
                           record_.mach_max,
                           record_.area_drift_max,
                           record_.volume_drift_max,
                           record_.displacement_max,
                           record_.stretch_max};
  return values[k];
}

void FixHemoWatch::write_restart(FILE* file) {
  const auto& r = record_;
  std::vector<double> state{static_cast<double>(last_),
                            static_cast<double>(cell_atoms_),
                            static_cast<double>(r.cells_start),
                            static_cast<double>(r.cells_end),
                            static_cast<double>(r.carriers_start),
                            static_cast<double>(r.carriers_end),
                            static_cast<double>(r.carriers_inside_max),
                            r.mach_max,
                            r.displacement_max,
                            r.stretch_max,
                            r.area_drift_max,
                            r.volume_drift_max};
  for (const auto& [tag, looks] : inside_)
    state.insert(state.end(), {static_cast<double>(tag), static_cast<double>(looks)});
  hemomag::lammps::write_state(file, comm->me, state);
}

void FixHemoWatch::restart(char* buffer) {
  hemomag::lammps::StateReader state(buffer);
  auto& r = record_;
  last_ = state.whole<bigint>();
  cell_atoms_ = state.whole<bigint>();
  for (bigint* count :
       {&r.cells_start, &r.cells_end, &r.carriers_start, &r.carriers_end, &r.carriers_inside_max})
    *count = state.whole<bigint>();
  for (double* most :
       {&r.mach_max, &r.displacement_max, &r.stretch_max, &r.area_drift_max, &r.volume_drift_max})
    *most = state.number();
  const auto inside = state.rest();
  for (std::size_t k = 0; k + 1 < inside.size(); k += 2)
    inside_[static_cast<tagint>(inside[k])] = static_cast<int>(inside[k + 1]);
  started_ = resumed_ = true;
}
