#include "lammps/fix_hemo_checkpoint.h"

#include <algorithm>
#include <csignal>
#include <limits>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "timer.h"
#include "update.h"
#include "utils.h"

#include "io/checkpoint_directory.hpp"
#include "io/files.hpp"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_fluid.h"
#include "lammps/fix_hemo_watch.h"
#include "solver/fluid_solver.hpp"

using namespace LAMMPS_NS;
namespace io = hemomag::io;
using hemomag::lammps::or_fail;
using hemomag::lammps::SignalsNoted;

namespace {

constexpr const char* atoms_file = "atoms.restart";
constexpr const char* fluid_file = "fluid.h5";
constexpr int consult_every = 10;                     // steps, where no list is made
constexpr double slow_step = 0.1;                     // seconds, from which each step is asked
constexpr double patience = 5;                        // seconds to wait for a step without a trace
constexpr double bytes_per_atom = 800, margin = 1e5;  // of LAMMPS's restart file; of the small ones
constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

FixHemoCheckpoint::FixHemoCheckpoint(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  parse(narg, arg);
  nevery = 1;
  force_reneighbor = 1;
  scalar_flag = vector_flag = 1;
  size_vector = 2;
  global_freq = 1;
  extscalar = extvector = 0;
  started_ = saved_ = MPI_Wtime();
  if (resumed_.empty()) saved_ = -never;  // the first one at the first occasion
}

void FixHemoCheckpoint::parse(int narg, char** arg) {
  if (narg < 4)
    error->all(FLERR,
               std::string("fix hemo/checkpoint needs DIR [interval SECONDS|never] [every N] "
                           "[keep FILE]... [resume DIR] [wall SECONDS]"));
  directory_ = arg[3];
  for (int at = 4; at < narg; at += 2) {
    const std::string key = arg[at];
    if (at + 1 == narg) error->all(FLERR, "fix hemo/checkpoint: " + key + " needs a value");
    const std::string value = arg[at + 1];
    if (key == "interval")
      interval_ = value == "never" ? never : utils::numeric(FLERR, value.c_str(), false, lmp);
    else if (key == "every")
      every_ = utils::inumeric(FLERR, value.c_str(), false, lmp);
    else if (key == "keep")
      kept_.push_back(value);
    else if (key == "resume")
      resumed_ = value;
    else if (key == "wall")
      wall_before_ = utils::numeric(FLERR, value.c_str(), false, lmp);
    else
      error->all(FLERR, "fix hemo/checkpoint: " + key +
                            " is unknown; accepted: interval, every, keep, resume, wall");
  }
  if (!(interval_ >= 0) || every_ < 2)
    error->all(FLERR,
               std::string("fix hemo/checkpoint: interval must be >= 0 and every at least 2"));
}

int FixHemoCheckpoint::setmask() {
  return FixConst::END_OF_STEP | FixConst::PRE_EXCHANGE | FixConst::PRE_NEIGHBOR;
}

void FixHemoCheckpoint::init() {
  fluid_ = hemomag::lammps::find_fix<FixHemoFluid>(lmp, "hemo/fluid");
  watch_ = hemomag::lammps::find_fix<FixHemoWatch>(lmp, "hemo/watch");
  bool last = false;
  for (int i = 0; i < modify->nfix; ++i) {
    if (modify->fix[i] == this)
      last = true;
    else if (last && modify->fix[i]->restart_global)
      error->all(FLERR,
                 "fix hemo/checkpoint must follow every fix that has a state: define it after "
                 "fix " +
                     std::string(modify->fix[i]->id));
  }
  // LAMMPS's own writer of restart files, in a rhythm that never comes.
  std::string rhythm = std::to_string(std::numeric_limits<int>::max());
  std::string file = io::unfinished(directory_) + "/" + atoms_file;
  char* arguments[] = {rhythm.data(), file.data(), file.data()};
  if (output->restart_flag_single ||
      (output->restart_flag_double && file != std::string(output->restart2a)))
    error->all(FLERR, std::string("fix hemo/checkpoint excludes the command `restart`"));
  if (!output->restart_flag_double) output->create_restart(3, arguments);
  if (resumed_.empty() || loaded_) return;
  if (fluid_) fluid_->load(resumed_ + "/" + fluid_file);
  last_step_ = update->ntimestep;
  restores_order_ = loaded_ = true;
}

// LAMMPS sorts atoms as it sets a run up, and anew every so many steps. The run that is resumed did
// not sort here.
void FixHemoCheckpoint::setup_pre_exchange() {
  sort_every_ = atom->sortfreq;
  if (restores_order_) atom->sortfreq = 0;
}

void FixHemoCheckpoint::setup_pre_neighbor() {
  atom->sortfreq = sort_every_;
  if (restores_order_ && sort_every_ > 0)
    atom->nextsort = (update->ntimestep / sort_every_ + 1) * sort_every_;
  restores_order_ = false;
}

void FixHemoCheckpoint::setup(int) { schedule(); }

/// The next step whose neighbour lists are made in any case: the last of the run, or the next
/// multiple of `every` or the step before it, whichever leaves populations at their own nodes.
void FixHemoCheckpoint::schedule() {
  const bigint now = update->ntimestep, even = every_ + every_ % 2;
  const bool other_pass = fluid_ && !fluid_->solver().settled();
  const bigint before = (now + (other_pass ? 1 : 0)) % 2;  // steps before a multiple
  next_reneighbor = ((now + before) / even + 1) * even - before;
  if (update->laststep > now) next_reneighbor = std::min(next_reneighbor, update->laststep);
}

/// Whether a run resumed from this step's state is the same as this one, bit by bit.
bool FixHemoCheckpoint::seamless() const {
  return neighbor->ago == 0 && (!fluid_ || fluid_->solver().settled());
}

/// What any rank wants, on every rank. Collective.
int FixHemoCheckpoint::consult() {
  int mine = signals_.seen(), all = 0;
  if (comm->me == 0) {
    const double now = MPI_Wtime(), steps = each_step_ ? 1 : consult_every;
    if (now - consulted_ > steps * slow_step) mine |= slow;
    consulted_ = now;
    if (interval_ < never && now - saved_ >= interval_) mine |= due;
    if (pending_ && now - wanted_since_ > patience) mine |= waited;
  }
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_BOR, world);
  each_step_ = all & slow;
  return all & ~slow;
}

void FixHemoCheckpoint::end_of_step() {
  const bigint now = update->ntimestep;
  const bool at_end = now == update->laststep;
  if (now >= next_reneighbor) schedule();
  if (!seamless() && !at_end && !each_step_ && !pending_ && now % consult_every != 0) return;
  const int wanted = consult();
  if (wanted && !pending_) wanted_since_ = MPI_Wtime();
  pending_ |= wanted;
  if (at_end || (pending_ && seamless())) {
    const int signal = pending_;
    if (last_step_ != now) save();
    if (at_end) return;
    if (signal & SignalsNoted::terminate)
      stop(SIGTERM);
    else if (signal & SignalsNoted::interrupt)
      stop(SIGINT);
  } else if (pending_ & waited) {
    // Nobody waits longer: the lists are made for it, and sums take another order from here on.
    const bool other_pass = fluid_ && fluid_->solver().settled();
    next_reneighbor = std::min(next_reneighbor, now + (other_pass ? 2 : 1));
  }
}

/// Part of a checkpoint; what there is of it goes when it fails.
template <class Work> void FixHemoCheckpoint::attempt(Work work) {
  or_fail(lmp, FLERR, [&] {
    try {
      work();
    } catch (...) {
      io::give_up_checkpoint(world, directory_);
      throw;
    }
  });
}

void FixHemoCheckpoint::save() {
  if (watch_) watch_->verify();
  const double start = MPI_Wtime();
  const double atoms = bytes_per_atom * static_cast<double>(atom->natoms);
  attempt([&] {
    io::begin_checkpoint(world, directory_,
                         atoms + margin + (fluid_ ? fluid_->solver().saved_bytes() : 0));
  });
  const std::string fresh = io::unfinished(directory_) + "/";
  std::vector<std::string> files{atoms_file};
  if (fluid_) {
    attempt([&] { fluid_->solver().save(fresh + fluid_file); });
    files.emplace_back(fluid_file);
  }
  // LAMMPS itself ends the run when it cannot write.
  auto& ending = hemomag::lammps::ending();
  ending = {hemomag::lammps::Cause::file_trouble,
            fresh + atoms_file + ": writing failed (disk full or read-only?)"};
  output->write_restart(update->ntimestep);
  ending = {};
  attempt([&] {
    for (const auto& file : kept_) {
      files.push_back(io::name_of(file));
      if (comm->me == 0) io::copy_file(file, fresh + files.back());
    }
  });
  attempt([&] {
    io::finish_checkpoint(world, directory_, files,
                          {static_cast<long>(update->ntimestep),
                           wall_before_ + MPI_Wtime() - started_, comm->nprocs});
  });
  served(MPI_Wtime() - start);
}

/// Note that there is a checkpoint of this step.
void FixHemoCheckpoint::served(double seconds) {
  signals_.served();
  pending_ = 0;
  last_step_ = update->ntimestep;
  saved_ = MPI_Wtime();
  spent_ += seconds;
  ++count_;
  if (comm->me == 0)
    utils::logmesg(lmp, "checkpoint of step " + std::to_string(last_step_) + " in " +
                            std::to_string(seconds) + " s\n");
}

/// The run ends here, and in order: LAMMPS believes that its time is up.
void FixHemoCheckpoint::stop(int signal) {
  hemomag::lammps::stopped_by() = signal;
  timer->force_timeout();
}

/// 1 checkpoints written, 2 seconds they took.
double FixHemoCheckpoint::compute_vector(int k) {
  return k == 0 ? static_cast<double>(count_) : spent_;
}
