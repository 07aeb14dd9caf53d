#include "lammps/fix_hemo_series.h"

#include "comm.h"
#include "compute.h"
#include "error.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

#include "io/files.hpp"
#include "lammps/compat.hpp"
#include "lammps/compute_hemo_margination.h"
#include "lammps/fix_state.hpp"

using namespace LAMMPS_NS;

FixHemoSeries::FixHemoSeries(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  if (narg < 6)
    error->all(FLERR,
               std::string("fix hemo/series needs N COMPUTE_ID FILE [dt_s DT] [average_from T]"));
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  if (nevery <= 0) error->all(FLERR, std::string("fix hemo/series: N must be > 0"));
  compute_id_ = arg[4];
  path_ = arg[5];
  for (int at = 6; at + 1 < narg; at += 2) {
    const std::string key = arg[at];
    const double value = utils::numeric(FLERR, arg[at + 1], false, lmp);
    if (key == "dt_s")
      dt_s_ = value;
    else if (key == "average_from")
      average_from_ = value;
    else
      error->all(FLERR, "fix hemo/series: " + key + " is unknown; accepted: dt_s, average_from");
  }
  vector_flag = 1;
  size_vector = 3;
  restart_global = 1;
  global_freq = nevery;
  extvector = 0;
}

FixHemoSeries::~FixHemoSeries() = default;

int FixHemoSeries::setmask() { return FixConst::END_OF_STEP; }

void FixHemoSeries::init() {
  const int found = modify->find_compute(compute_id_);
  if (found < 0) error->all(FLERR, "fix hemo/series: there is no compute " + compute_id_);
  compute_ = modify->compute[found];
  if (!compute_->vector_flag || compute_->size_vector < 2)
    error->all(FLERR, "fix hemo/series: compute " + compute_id_ + " is not a hemo/margination");
  if (auto* margination = dynamic_cast<ComputeHemoMargination*>(compute_);
      margination && carriers_at_start_)
    margination->resume(*carriers_at_start_);
  hemomag::lammps::or_fail(lmp, FLERR, [&] {
    if (file_ || comm->me != 0) return;
    file_ = std::make_unique<hemomag::io::CsvFile>(
        resumed_at_ ? hemomag::io::CsvFile::resume(path_, *resumed_at_)
                    : hemomag::io::CsvFile(path_, "time_s,in_layer,probability"));
  });
}

void FixHemoSeries::setup(int) {
  if (last_ < 0) record();
}

void FixHemoSeries::end_of_step() { record(); }

void FixHemoSeries::record() {
  last_ = update->ntimestep;
  compute_->compute_vector();
  in_layer_ = compute_->vector[0];
  probability_ = compute_->vector[1];
  const double time = static_cast<double>(update->ntimestep) * dt_s_;
  if (time >= average_from_) {
    sum_ += probability_;
    ++rows_;
  }
  if (!file_) return;
  try {
    file_->row({time, in_layer_, probability_});
  } catch (const hemomag::Error& e) {
    hemomag::lammps::fail_here(lmp, FLERR, e);
  }
}

void FixHemoSeries::write_restart(FILE* file) {
  const auto* margination = dynamic_cast<ComputeHemoMargination*>(compute_);
  try {
    const double length = file_ ? static_cast<double>(file_->sync()) : 0;
    hemomag::lammps::write_state(
        file, comm->me,
        {static_cast<double>(last_), in_layer_, probability_, sum_, static_cast<double>(rows_),
         margination ? static_cast<double>(margination->at_start()) : -1, length});
  } catch (const hemomag::Error& e) {
    hemomag::lammps::fail_here(lmp, FLERR, e);
  }
}

void FixHemoSeries::restart(char* buffer) {
  hemomag::lammps::StateReader state(buffer);
  last_ = state.whole<bigint>();
  in_layer_ = state.number();
  probability_ = state.number();
  sum_ = state.number();
  rows_ = state.whole<long>();
  carriers_at_start_ = state.whole<long>();
  resumed_at_ = state.whole<long>();
}

/// 1 carriers in the layer, 2 probability now, 3 its mean.
double FixHemoSeries::compute_vector(int k) {
  return k == 0 ? in_layer_ : k == 1 ? probability_ : probability_mean();
}
