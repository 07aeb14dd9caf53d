#include "app/cell_run.hpp"

#include <cstdio>

#include "case/cells_data.hpp"
#include "case/lattice_units.hpp"
#include "case/placement.hpp"
#include "case/script.hpp"
#include "io/files.hpp"
#include "lammps/compat.hpp"
#include "lammps/compute_hemo_cell.h"
#include "lammps/positions.hpp"

namespace hemomag::app {
namespace {

constexpr double um = 1e-6, pN = 1e-12;

Vec3 box(const CellRun::Options& o) {
  return o.shear_rate > 0 ? CellRun::shear_box : CellRun::periodic_box;
}

case_::Case one_cell(const CellRun::Options& o) {
  case_::Case c;
  c.title = "one cell";
  const Vec3 size = um * box(o);
  c.channel.size = {size.x, size.y, size.z};
  c.channel.boundary = o.shear_rate > 0 ? case_::Boundary::plates : case_::Boundary::periodic;
  c.channel.plates = case_::Plates::symmetric;
  c.channel.shear_rate = o.shear_rate;
  c.fluid.viscosity = 1.2e-3;
  c.numerics.dx = o.dx * um;
  c.numerics.dt = o.dt;
  c.cells.emplace_back();
  c.cells[0].vertices = o.vertices;
  c.cells[0].count = 1;
  c.cells[0].hinges = o.hinges;
  c.cells[0].stress_free = o.stress_free;
  c.run.steps = 0;
  c.output.series.reset();
  return c;
}

/// `group NAME id` with LAMMPS's tags, which count from 1.
std::string group(const char* name, const std::vector<int>& vertices) {
  std::string line = std::string("group ").append(name).append(" id");
  for (const int v : vertices) line.append(" ").append(std::to_string(v + 1));
  return line;
}

}  // namespace

membrane::TriangleMesh CellRun::rest_mesh(int vertices) {
  Options o;
  o.vertices = vertices;
  auto mesh = case_::cell_models(one_cell(o))[0].mesh;
  for (Vec3& p : mesh.x) p *= 1 / um;
  return mesh;
}

CellRun::CellRun(const std::string& out, const std::vector<Vec3>& start, const Options& options)
    : middle_(0.5 * box(options)), dx_(options.dx), dt_(options.dt) {
  const case_::Case c = one_cell(options);
  force_unit_ = case_::lattice_units(c).force() / pN;
  case_::System system;
  system.models = case_::cell_models(c);
  system.cells.push_back({0, start});
  for (Vec3& p : system.cells[0].x) p = um * (p + middle_);
  const Grips held = grips(system.models[0].mesh.x, options.fraction);
  held_ = held.low.size();

  io::make_directory(out);
  const std::string data = out + "/cell.data";
  io::replace_file(data, case_::cells_data(c, system));
  const std::string read_data = std::string("read_data \"").append(data).append("\"");
  host_ = std::make_unique<lammps::Host>(
      std::vector<std::string>{"-screen", "none", "-log", "none"}, MPI_COMM_SELF);
  const std::string script = case_::lammps_script(c, system);
  for (std::size_t at = 0; at < script.size();) {
    const std::size_t end = script.find('\n', at);
    const std::string line = script.substr(at, end - at);
    at = end + 1;
    if (line.rfind("run ", 0) == 0) break;
    // The fluid spreads the forces that are on the atoms when its turn comes: pull before it.
    if (line.rfind("fix fluid ", 0) == 0) {
      host_->command(group("low", held.low));
      host_->command(group("high", held.high));
      pull(0);
      host_->command("fix pull_low low addforce v_minus_pull 0 0");
      host_->command("fix pull_high high addforce v_pull 0 0");
    }
    host_->command(line == "read_data cells.data" ? read_data : line);
  }
  host_->command("thermo 0");  // the fluid's mass of every step is half the time of a small box
  host_->command("compute motion cells hemo/cell");
}

void CellRun::pull(double force) {
  const double each = force / force_unit_ / static_cast<double>(held_);
  char line[96];
  std::snprintf(line, sizeof line, "variable pull equal %.17g", each);
  host_->command(line);
  std::snprintf(line, sizeof line, "variable minus_pull equal %.17g", -each);
  host_->command(line);
}

void CellRun::run(long steps) {
  host_->command("run " + std::to_string(steps) + " post no");
  steps_ += steps;
}

CellRun::Motion CellRun::motion() {
  using Compute = LAMMPS_NS::ComputeHemoCell;
  auto* cell = lammps::find_compute<Compute>(&host_->lammps(), "motion");
  cell->compute_array();
  const double* row = cell->array[0];
  Motion m{row[Compute::phase] - row[Compute::treading], row[Compute::phase], {}};
  for (std::size_t i = 0; i < 3; ++i) m.semi_axes[i] = row[Compute::semi_axes + i] * dx_;
  return m;
}

std::vector<Vec3> CellRun::x() const {
  auto x = lammps::positions(host_->lammps());
  for (Vec3& p : x) p = dx_ * p - middle_;
  return x;
}

}  // namespace hemomag::app
