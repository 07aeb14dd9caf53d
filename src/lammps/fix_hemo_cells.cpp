#include "lammps/fix_hemo_cells.h"

#include <numeric>
#include <vector>

#include "comm.h"
#include "error.h"
#include "update.h"
#include "utils.h"

#include "io/files.hpp"
#include "lammps/compat.hpp"
#include "lammps/compute_hemo_cell.h"
#include "lammps/fix_state.hpp"

using namespace LAMMPS_NS;

namespace {

constexpr const char* header =
    "time_s,cell,volume_um3,area_um2,x_um,y_um,z_um,vx_mm_per_s,vy_mm_per_s,vz_mm_per_s,"
    "a_um,b_um,c_um,a_x,a_y,a_z,c_x,c_y,c_z,taylor,taylor_in_plane,inclination_deg,phase_deg,"
    "treading_deg,extent_x_um,extent_y_um,extent_z_um";

}  // namespace

FixHemoCells::FixHemoCells(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  if (narg < 6)
    error->all(
        FLERR,
        std::string("fix hemo/cells needs N COMPUTE_ID FILE [dx_um DX] [dt_s DT] [follow M]"));
  write_every_ = follow_every_ = utils::inumeric(FLERR, arg[3], false, lmp);
  compute_id_ = arg[4];
  path_ = arg[5];
  for (int at = 6; at + 1 < narg; at += 2) {
    const std::string key = arg[at];
    if (key == "dx_um")
      dx_um_ = utils::numeric(FLERR, arg[at + 1], false, lmp);
    else if (key == "dt_s")
      dt_s_ = utils::numeric(FLERR, arg[at + 1], false, lmp);
    else if (key == "follow")
      follow_every_ = utils::inumeric(FLERR, arg[at + 1], false, lmp);
    else
      error->all(FLERR, "fix hemo/cells: " + key + " is unknown; accepted: dx_um, dt_s, follow");
  }
  if (write_every_ <= 0 || follow_every_ <= 0)
    error->all(FLERR, std::string("fix hemo/cells: N and follow must be > 0"));
  nevery = std::gcd(write_every_, follow_every_);
  restart_global = 1;
}

FixHemoCells::~FixHemoCells() = default;

int FixHemoCells::setmask() { return FixConst::END_OF_STEP; }

void FixHemoCells::init() {
  compute_ = hemomag::lammps::find_compute<ComputeHemoCell>(lmp, compute_id_);
  if (!compute_)
    error->all(FLERR, "fix hemo/cells: there is no compute hemo/cell named " + compute_id_);
  if (!followed_.empty())
    hemomag::lammps::or_fail(lmp, FLERR, [&] { compute_->resume(followed_); });
  followed_.clear();
  hemomag::lammps::or_fail(lmp, FLERR, [&] {
    if (file_ || comm->me != 0) return;
    file_ = std::make_unique<hemomag::io::CsvFile>(
        resumed_at_ ? hemomag::io::CsvFile::resume(path_, *resumed_at_)
                    : hemomag::io::CsvFile(path_, header));
  });
}

void FixHemoCells::setup(int) {
  if (last_ < 0) write();
}

/// Rows every N steps; between them the compute only keeps count of turns.
void FixHemoCells::end_of_step() {
  if (update->ntimestep % write_every_ == 0)
    write();
  else if (update->ntimestep % follow_every_ == 0)
    compute_->compute_array();
}

void FixHemoCells::write() {
  last_ = update->ntimestep;
  compute_->compute_array();
  if (!file_) return;
  const double um = dx_um_, um2 = um * um, um3 = um2 * um;
  const double mm_per_s = 1e-3 * dx_um_ / dt_s_;
  // One factor a column, in the order of ComputeHemoCell::Column and of the header after the time.
  const double unit[] = {1, um3, um2, um, um, um, mm_per_s, mm_per_s, mm_per_s, um, um, um, 1,
                         1, 1,   1,   1,  1,  1,  1,        1,        1,        1,  um, um, um};
  static_assert(std::size(unit) == ComputeHemoCell::columns);
  std::vector<double> row(1 + std::size(unit));
  row[0] = static_cast<double>(update->ntimestep) * dt_s_;
  try {
    for (int r = 0; r < compute_->size_array_rows; ++r) {
      for (std::size_t k = 0; k < std::size(unit); ++k)
        row[k + 1] = compute_->array[r][k] * unit[k];
      file_->row(row);
    }
  } catch (const hemomag::Error& e) {
    hemomag::lammps::fail_here(lmp, FLERR, e);
  }
}

void FixHemoCells::write_restart(FILE* file) {
  try {
    const double length = file_ ? static_cast<double>(file_->sync()) : 0;
    std::vector<double> state{static_cast<double>(last_), length};
    const auto followed = compute_->followed();
    state.insert(state.end(), followed.begin(), followed.end());
    hemomag::lammps::write_state(file, comm->me, state);
  } catch (const hemomag::Error& e) {
    hemomag::lammps::fail_here(lmp, FLERR, e);
  }
}

void FixHemoCells::restart(char* buffer) {
  hemomag::lammps::StateReader state(buffer);
  last_ = state.whole<bigint>();
  resumed_at_ = state.whole<long>();
  followed_ = state.rest();
}
