#include "lammps/fix_hemo_progress.h"

#include <cstdio>
#include <string>

#include <mpi.h>
#include <unistd.h>

#include "comm.h"
#include "error.h"
#include "update.h"
#include "utils.h"

#include "lammps/compat.hpp"
#include "lammps/fix_hemo_series.h"

using namespace LAMMPS_NS;

namespace {
constexpr double terminal_interval = 0.5, log_interval = 5;  // seconds between lines
}

FixHemoProgress::FixHemoProgress(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  if (narg != 5 || std::string(arg[3]) != "dt_s")
    error->all(FLERR, std::string("fix hemo/progress needs dt_s DT"));
  dt_s_ = utils::numeric(FLERR, arg[4], false, lmp);
  nevery = 1;
  terminal_ = isatty(STDOUT_FILENO) != 0;
}

int FixHemoProgress::setmask() { return FixConst::END_OF_STEP | FixConst::POST_RUN; }

void FixHemoProgress::init() {
  series_ = hemomag::lammps::find_fix<FixHemoSeries>(lmp, "hemo/series");
}

void FixHemoProgress::setup(int) {
  first_ = update->ntimestep;
  started_ = printed_ = MPI_Wtime();
}

void FixHemoProgress::end_of_step() {
  if (comm->me != 0) return;
  const double now = MPI_Wtime();
  if (now - printed_ >= (terminal_ ? terminal_interval : log_interval)) print(now);
}

void FixHemoProgress::post_run() {
  if (comm->me != 0) return;
  print(MPI_Wtime());
  if (terminal_) std::printf("\n");
}

void FixHemoProgress::print(double now) {
  printed_ = now;
  const auto done = static_cast<double>(update->ntimestep - first_);
  const double rate = done > 0 ? done / (now - started_) : 0;
  const double left =
      rate > 0 ? static_cast<double>(update->laststep - update->ntimestep) / rate : 0;
  std::printf("%sstep %lld of %lld  %.0f steps/s  t = %.4f s  %.0f s left", terminal_ ? "\r" : "",
              static_cast<long long>(update->ntimestep), static_cast<long long>(update->laststep),
              rate, static_cast<double>(update->ntimestep) * dt_s_, left);
  if (series_) std::printf("  %.0f carriers in the layer", series_->in_layer());
  std::printf(terminal_ ? "   " : "\n");
  std::fflush(stdout);
}
