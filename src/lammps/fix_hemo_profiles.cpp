#include "lammps/fix_hemo_profiles.h"

#include <cmath>
#include <cstdio>
#include <span>
#include <string>

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "update.h"
#include "utils.h"

#include "analysis/cell_free_layer.hpp"
#include "io/files.hpp"
#include "lammps/angle_hemo_membrane.h"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_fluid.h"
#include "lammps/fix_state.hpp"
#include "solver/fluid_solver.hpp"

using namespace LAMMPS_NS;
namespace analysis = hemomag::analysis;
using hemomag::Vec3;

namespace {

constexpr const char* series_header =
    "time_s,layer_lower_um,layer_upper_um,seen_lower_um,seen_upper_um,drag_lower_pa,drag_upper_pa,"
    "velocity_mm_per_s";
constexpr const char* profile_header =
    "z_um,hematocrit,hematocrit_sd,velocity_mm_per_s,velocity_sd_mm_per_s";

}  // namespace

FixHemoProfiles::FixHemoProfiles(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  if (narg < 5)
    error->all(FLERR, std::string("fix hemo/profiles needs N FILE [series FILE] [dx_um DX] [dt_s "
                                  "DT] [stress_pa S] [average_from T] [spacing L]"));
  sample_every_ = utils::inumeric(FLERR, arg[3], false, lmp);
  if (sample_every_ <= 0) error->all(FLERR, std::string("fix hemo/profiles: N must be > 0"));
  profile_path_ = arg[4];
  for (int at = 5; at + 1 < narg; at += 2) {
    const std::string key = arg[at];
    if (key == "series") {
      series_path_ = arg[at + 1];
      continue;
    }
    const double value = utils::numeric(FLERR, arg[at + 1], false, lmp);
    if (key == "dx_um")
      dx_um_ = value;
    else if (key == "dt_s")
      dt_s_ = value;
    else if (key == "stress_pa")
      stress_pa_ = value;
    else if (key == "average_from")
      average_from_ = value;
    else if (key == "spacing" && value > 0)
      spacing_ = value;
    else
      error->all(FLERR, "fix hemo/profiles: " + key + " " + arg[at + 1] +
                            "; accepted: series FILE, dx_um DX, dt_s DT, stress_pa S, average_from "
                            "T, spacing L with L > 0");
  }
  nevery = 1;  // the drag on the plates is averaged over every step
  vector_flag = restart_global = 1;
  size_vector = scalars + 1;
  global_freq = 1;
  extvector = 0;
}

FixHemoProfiles::~FixHemoProfiles() = default;

int FixHemoProfiles::setmask() { return FixConst::END_OF_STEP | FixConst::POST_RUN; }

void FixHemoProfiles::init() {
  fluid_ = hemomag::lammps::find_fix<FixHemoFluid>(lmp, "hemo/fluid");
  if (!fluid_ || fluid_->solver().parameters().plate_axis != 2)
    error->all(FLERR, std::string("fix hemo/profiles needs a fix hemo/fluid with plates z"));
  membrane_ = dynamic_cast<AngleHemoMembrane*>(force->angle_match("hemo/membrane"));
  slabs_ = static_cast<std::size_t>(fluid_->solver().block().global[2]);
  now_.resize(2 * slabs_ + scalars);
  facing_ = std::make_unique<analysis::FacingSurfaces>(
      Vec3{domain->xprd, domain->yprd, domain->zprd}, spacing_);
  hemomag::lammps::or_fail(lmp, FLERR, [&] {
    if (!series_ && !series_path_.empty() && comm->me == 0)
      series_ = std::make_unique<hemomag::io::CsvFile>(
          resumed_at_ ? hemomag::io::CsvFile::resume(series_path_, *resumed_at_)
                      : hemomag::io::CsvFile(series_path_, series_header));
  });
}

/// Drag counts from here on.
void FixHemoProfiles::setup(int) {
  if (last_ >= 0) return;
  last_ = update->ntimestep;
  const auto& book = fluid_->solver().wall_book();
  booked_ = {book.momentum[0].y, book.momentum[1].y};
  booked_steps_ = book.steps;
}

void FixHemoProfiles::end_of_step() {
  add_share();
  if (update->ntimestep % sample_every_ == 0) sample();
}

void FixHemoProfiles::post_run() {
  if (comm->me == 0) write_profiles();
}

void FixHemoProfiles::write_restart(FILE* file) {
  double length = 0;
  hemomag::lammps::or_fail(lmp, FLERR, [&] {
    if (series_) length = static_cast<double>(series_->sync());
  });
  std::vector<double> state{static_cast<double>(last_), length, static_cast<double>(share_steps_),
                            static_cast<double>(booked_steps_)};
  const auto append = [&](const std::vector<double>& values) {
    state.insert(state.end(), values.begin(), values.end());
  };
  append(
      hemomag::lammps::of_each_rank(world, {share_sum_[0], share_sum_[1], booked_[0], booked_[1]}));
  for (const auto& list : {now_, all_.state(), late_.state()}) {
    state.push_back(static_cast<double>(list.size()));
    append(list);
  }
  hemomag::lammps::write_state(file, comm->me, state);
}

void FixHemoProfiles::restart(char* buffer) {
  hemomag::lammps::StateReader state(buffer);
  last_ = state.whole<bigint>();
  resumed_at_ = state.whole<long>();
  share_steps_ = state.whole<long>();
  booked_steps_ = state.whole<long>();
  const auto mine = state.own(world, 4);
  share_sum_ = {mine[0], mine[1]};
  booked_ = {mine[2], mine[3]};
  const auto list = [&] { return state.numbers(state.whole<std::size_t>()); };
  now_ = list();
  all_ = analysis::Moments::from(list());
  late_ = analysis::Moments::from(list());
}

/// The plates' share of the forces that were spread next to them in this step.
void FixHemoProfiles::add_share() {
  for (std::size_t side = 0; side < 2; ++side)
    share_sum_[side] += fluid_->solver().wall_shares()[side].y;
  ++share_steps_;
}

/// This rank's part of the drag on the plates since the last sample, by bounce-back and by their
/// share of spread forces.
void FixHemoProfiles::measure_drag() {
  const auto& book = fluid_->solver().wall_book();
  const double plate = domain->xprd * domain->yprd;
  const long booked = book.steps - booked_steps_;
  for (std::size_t side = 0; side < 2; ++side) {
    const double bounced = book.momentum[side].y - booked_[side];
    now_[2 * slabs_ + drag + side] = ((booked > 0 ? bounced / static_cast<double>(booked) : 0.0) +
                                      share_sum_[side] / static_cast<double>(share_steps_)) /
                                     plate;
    booked_[side] = book.momentum[side].y;
  }
  booked_steps_ = book.steps;
  share_sum_ = {};
  share_steps_ = 0;
}

void FixHemoProfiles::sample() {
  last_ = update->ntimestep;
  std::fill(now_.begin(), now_.end(), 0.0);
  measure_cells();
  measure_fluid();
  measure_drag();
  MPI_Allreduce(MPI_IN_PLACE, now_.data(), static_cast<int>(now_.size()), MPI_DOUBLE, MPI_SUM,
                world);
  const auto facing = facing_->distances();
  MPI_Allreduce(MPI_IN_PLACE, facing.data(), static_cast<int>(facing.size()), MPI_DOUBLE, MPI_MIN,
                world);
  for (std::size_t side = 0; side < 2; ++side) {
    const auto free = facing_->layer(static_cast<int>(side));
    now_[2 * slabs_ + layer + side] = free.mean;
    now_[2 * slabs_ + seen + side] = free.seen;
  }
  all_.add(now_);
  if (static_cast<double>(last_) * dt_s_ >= average_from_) late_.add(now_);
  try {
    if (series_) write_row();
  } catch (const hemomag::Error& e) {
    hemomag::lammps::fail_here(lmp, FLERR, std::string(e.what()));
  }
}

/// Volume fraction of this rank's triangles in every slab, and the surfaces that face the plates.
void FixHemoProfiles::measure_cells() {
  facing_->clear();
  if (!membrane_) return;
  const auto surface = membrane_->surface();
  const std::span<double> hematocrit(now_.data(), slabs_);
  analysis::add_enclosed_volume(surface.triangles, 1.0, hematocrit);
  for (double& ht : hematocrit) ht /= domain->xprd * domain->yprd;
  facing_->add(surface.triangles);
}

/// This rank's part of the mean velocity along y in every layer of nodes, and over the channel.
void FixHemoProfiles::measure_fluid() {
  auto& solver = fluid_->solver();
  const auto& block = solver.block();
  std::vector<double> rho(block.owned());
  std::vector<Vec3> u(block.owned());
  solver.copy_owned(rho, u);
  const auto plane =
      static_cast<std::size_t>(block.size[0]) * static_cast<std::size_t>(block.size[1]);
  const double nodes = static_cast<double>(block.global[0]) * block.global[1];
  double whole = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const std::size_t slab = static_cast<std::size_t>(block.begin[2]) + k / plane;
    now_[slabs_ + slab] += u[k].y / nodes;
    whole += u[k].y;
  }
  now_[2 * slabs_ + velocity] = whole / nodes / static_cast<double>(slabs_);
}

FixHemoProfiles::Mean FixHemoProfiles::mean_of(std::size_t k, double unit) const {
  return {averaged().mean(k) * unit, averaged().deviation(k) * unit};
}

analysis::PlateFlow FixHemoProfiles::mean_flow(const analysis::Moments& m) const {
  const auto& plates = fluid_->solver().parameters().plate_velocity;
  const std::size_t at = 2 * slabs_;
  // A node's velocity exceeds the mean of its layer by -u''/24 (of a parabola exactly), whose sum
  // over the layers is the difference of the slopes at the plates, drag over viscosity.
  const double correction = (m.mean(at + drag) + m.mean(at + drag + 1)) /
                            (24 * fluid_->viscosity() * static_cast<double>(slabs_));
  return {{m.mean(at + drag), m.mean(at + drag + 1)},
          {plates[0].y, plates[1].y},
          static_cast<double>(slabs_),
          m.mean(at + velocity) - correction};
}

FixHemoProfiles::Results FixHemoProfiles::results() const {
  Results r;
  r.samples = averaged().count();
  const std::size_t at = 2 * slabs_;
  std::vector<double> up(slabs_), down(slabs_);
  for (std::size_t k = 0; k < slabs_; ++k) {
    up[k] = down[slabs_ - 1 - k] = averaged().mean(k);
    r.hematocrit += up[k] / static_cast<double>(slabs_);
  }
  r.half_core = {analysis::half_core_height(up, 1.0) * dx_um_,
                 analysis::half_core_height(down, 1.0) * dx_um_};
  for (std::size_t side = 0; side < 2; ++side) {
    r.layer[side] = mean_of(at + layer + side, dx_um_);
    r.seen[side] = mean_of(at + seen + side, dx_um_);
    r.drag[side] = mean_of(at + drag + side, stress_pa_);
  }
  r.velocity = mean_of(at + velocity, 1e-3 * dx_um_ / dt_s_);

  const auto flow = mean_flow(averaged());
  const auto& p = fluid_->solver().parameters();
  const bool sheared = flow.plate_speed[0] != flow.plate_speed[1];
  const bool driven = p.relaxation.force[1] != 0;
  if (sheared && !driven)
    r.relative_viscosity = apparent_viscosity_couette(flow) / fluid_->viscosity();
  else if (driven && flow.plate_speed == std::array{0.0, 0.0} && flow.mean_velocity != 0)
    r.relative_viscosity = apparent_viscosity_poiseuille(flow) / fluid_->viscosity();
  return r;
}

void FixHemoProfiles::write_row() const {
  std::vector<double> row{static_cast<double>(last_) * dt_s_};
  const double unit[scalars] = {
      dx_um_, dx_um_, dx_um_, dx_um_, stress_pa_, stress_pa_, 1e-3 * dx_um_ / dt_s_};
  for (std::size_t k = 0; k < scalars; ++k) row.push_back(now_[2 * slabs_ + k] * unit[k]);
  series_->row(row);
}

void FixHemoProfiles::write_profiles() const {
  const double mm_per_s = 1e-3 * dx_um_ / dt_s_;
  std::string text = std::string(profile_header) + "\n";
  const std::size_t rows = averaged().count() > 0 ? slabs_ : 0;
  for (std::size_t k = 0; k < rows; ++k) {
    const Mean ht = mean_of(k, 1), u = mean_of(slabs_ + k, mm_per_s);
    char line[160];
    std::snprintf(line, sizeof line, "%.9g,%.9g,%.9g,%.9g,%.9g\n",
                  (static_cast<double>(k) + 0.5) * dx_um_, ht.mean, ht.deviation, u.mean,
                  u.deviation);
    text += line;
  }
  try {
    hemomag::io::replace_file(profile_path_, text);
  } catch (const hemomag::Error& e) {
    hemomag::lammps::fail_here(lmp, FLERR, std::string(e.what()));
  }
}

/// Of the last sample, in lattice units: 1, 2 layer at the lower and upper plate, 3, 4 the same as
/// seen along x, 5, 6 drag along y on them, per area, 7 mean velocity along y; 8 hematocrit.
double FixHemoProfiles::compute_vector(int k) {
  if (now_.empty()) return 0;
  if (k < scalars) return now_[2 * slabs_ + static_cast<std::size_t>(k)];
  double sum = 0;
  for (std::size_t s = 0; s < slabs_; ++s) sum += now_[s];
  return sum / static_cast<double>(slabs_);
}
