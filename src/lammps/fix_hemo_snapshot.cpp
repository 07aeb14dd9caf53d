#include "lammps/fix_hemo_snapshot.h"

#include <cstdio>
#include <unordered_map>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "update.h"
#include "utils.h"

#include "io/vtkhdf.hpp"
#include "lammps/angle_hemo_membrane.h"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_drag.h"
#include "lammps/fix_hemo_field.h"
#include "lammps/fix_hemo_fluid.h"
#include "lammps/fix_state.hpp"
#include "solver/fluid_solver.hpp"

using namespace LAMMPS_NS;
namespace io = hemomag::io;
using hemomag::Vec3;

FixHemoSnapshot::FixHemoSnapshot(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  if (narg < 5)
    error->all(FLERR, std::string("fix hemo/snapshot needs N DIRECTORY [dx_um DX] [dt_s DT]"));
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  if (nevery <= 0) error->all(FLERR, std::string("fix hemo/snapshot: N must be > 0"));
  directory_ = arg[4];
  restart_global = 1;
  for (int at = 5; at + 1 < narg; at += 2) {
    const std::string key = arg[at];
    const double value = utils::numeric(FLERR, arg[at + 1], false, lmp);
    if (key == "dx_um")
      dx_um_ = value;
    else if (key == "dt_s")
      dt_s_ = value;
    else
      error->all(FLERR, "fix hemo/snapshot: " + key + " is unknown; accepted: dx_um, dt_s");
  }
}

int FixHemoSnapshot::setmask() { return FixConst::END_OF_STEP; }

void FixHemoSnapshot::init() {
  if (!kinds_.empty()) return;
  hemomag::lammps::or_fail(lmp, FLERR, [&] { io::make_directory(directory_); });
  const auto add = [&](const char* name, void (FixHemoSnapshot::*write)(const std::string&)) {
    kinds_.push_back({name, write, io::SeriesIndex(directory_ + "/" + name + ".vtkhdf.series")});
  };
  fluid_ = hemomag::lammps::find_fix<FixHemoFluid>(lmp, "hemo/fluid");
  if (fluid_) add("fluid", &FixHemoSnapshot::write_fluid);
  if (force->angle_match("hemo/membrane")) add("cells", &FixHemoSnapshot::write_cells);
  if (hemomag::lammps::find_fix<FixHemoDrag>(lmp, "hemo/drag"))
    add("carriers", &FixHemoSnapshot::write_carriers);
  hemomag::lammps::or_fail(lmp, FLERR, [&] {
    for (auto& kind : kinds_)
      if (comm->me == 0 && count_ > 0) kind.index.resume(static_cast<std::size_t>(count_));
  });
}

void FixHemoSnapshot::setup(int) {
  if (last_ < 0) write();
}

void FixHemoSnapshot::end_of_step() { write(); }

void FixHemoSnapshot::write() {
  last_ = update->ntimestep;
  char number[16];
  std::snprintf(number, sizeof number, "_%05d", count_++);
  for (auto& kind : kinds_) {
    const std::string file = std::string(kind.name) + number + ".vtkhdf";
    const std::string path = directory_ + "/" + file;
    hemomag::lammps::or_fail(lmp, FLERR, [&] { (this->*kind.write)(path); });
    hemomag::lammps::or_fail(lmp, FLERR, [&] {
      if (comm->me == 0) kind.index.add(file, static_cast<double>(last_) * dt_s_);
    });
    unsynced_.push_back(path);
  }
}

void FixHemoSnapshot::write_fluid(const std::string& path) {
  auto& solver = fluid_->solver();
  const std::size_t n = solver.block().owned();
  std::vector<double> rho(n);
  std::vector<Vec3> u(n);
  solver.copy_owned(rho, u);
  io::DataArray density{"density", 1, std::move(rho)}, velocity{"velocity_m_per_s", 3, {}};
  const double metres_per_second = dx_um_ * 1e-6 / dt_s_;
  velocity.values.reserve(3 * n);
  for (const Vec3& v : u)
    for (std::size_t d = 0; d < 3; ++d) velocity.values.push_back(v[d] * metres_per_second);
  io::write_image(world, path, solver.block(), dx_um_, {density, velocity});
}

/// Triangles of all cells, each cell in one piece even where it crosses a periodic border.
void FixHemoSnapshot::write_cells(const std::string& path) {
  const auto* membrane = dynamic_cast<AngleHemoMembrane*>(force->angle_match("hemo/membrane"));
  const auto surface = membrane->surface();
  std::vector<double> points;
  std::vector<std::int64_t> corners;
  io::DataArray cell_id{"cell_id", 1, {}};
  std::unordered_map<std::int64_t, std::int64_t> point_of;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& triangle = surface.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, fresh] =
          point_of.try_emplace(triangle.tag[k], static_cast<std::int64_t>(points.size() / 3));
      if (fresh)
        for (std::size_t d = 0; d < 3; ++d) points.push_back(triangle.x[k][d] * dx_um_);
      corners.push_back(at->second);
    }
    cell_id.values.push_back(static_cast<double>(surface.molecule[t]));
  }
  io::write_grid(world, path, io::Shape::triangle, points, corners, {}, {cell_id});
}

void FixHemoSnapshot::write_carriers(const std::string& path) {
  const auto* drag = hemomag::lammps::find_fix<FixHemoDrag>(lmp, "hemo/drag");
  auto* field = hemomag::lammps::find_fix<FixHemoField>(lmp, "hemo/field");
  const double metres_per_second = dx_um_ * 1e-6 / dt_s_;
  std::vector<double> points;
  std::vector<std::int64_t> corners;
  io::DataArray velocity{"velocity_m_per_s", 3, {}}, id{"carrier_id", 1, {}},
      worm{"worm_id", 1, {}}, moment{"moment_lattice", 3, {}};
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & drag->groupbit)) continue;
    corners.push_back(static_cast<std::int64_t>(corners.size()));
    for (int d = 0; d < 3; ++d) {
      points.push_back(atom->x[i][d] * dx_um_);
      velocity.values.push_back(atom->v[i][d] * metres_per_second);
      moment.values.push_back(field ? field->moments()[i][d] : 0.0);
    }
    id.values.push_back(static_cast<double>(atom->tag[i]));
    worm.values.push_back(static_cast<double>(atom->molecule[i]));
  }
  io::write_grid(world, path, io::Shape::vertex, points, corners, {velocity, id, worm, moment}, {});
}

/// A checkpoint relies on the snapshots before it: they are on the disk first, each rank's part by
/// itself.
void FixHemoSnapshot::write_restart(FILE* file) {
  try {
    for (const auto& path : unsynced_)
      if (io::is_readable(path)) io::sync_file(path);  // else somebody took it away
  } catch (const hemomag::Error& e) {
    hemomag::lammps::fail_here(lmp, FLERR, e);
  }
  unsynced_.clear();
  hemomag::lammps::write_state(file, comm->me,
                               {static_cast<double>(last_), static_cast<double>(count_)});
}

void FixHemoSnapshot::restart(char* buffer) {
  hemomag::lammps::StateReader state(buffer);
  last_ = state.whole<bigint>();
  count_ = state.whole<int>();
}
