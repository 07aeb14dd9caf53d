#include "app/carrier_run.hpp"

#include <cstdarg>
#include <cstdio>

#include <mpi.h>

#include "lammps/compat.hpp"
#include "lammps/fix_hemo_drag.h"
#include "lammps/fix_hemo_fluid.h"
#include "lammps/positions.hpp"
#include "solver/fluid_solver.hpp"

namespace hemomag::app {

namespace {

solver::FluidSolver& fluid(lammps::Host& host) {
  return lammps::find_fix<LAMMPS_NS::FixHemoFluid>(&host.lammps(), "hemo/fluid")->solver();
}

}  // namespace

std::string format(const char* text, ...) {
  char buffer[512];
  va_list args;
  va_start(args, text);
  std::vsnprintf(buffer, sizeof buffer, text, args);
  va_end(args);
  return buffer;
}

CarrierRun::CarrierRun(const Setup& s) : host_({"-screen", "none", "-log", "none"}, MPI_COMM_SELF) {
  const bool plates = s.walls == Setup::Walls::plates;
  const auto types = s.radii.empty() ? static_cast<std::size_t>(s.types) : s.radii.size();
  for (const char* line : {"units lj", "atom_style molecular", "newton on"}) command(line);
  command(plates ? "boundary p p f" : "boundary p p p");
  command(format("region box block 0 %d 0 %d 0 %d", s.nodes[0], s.nodes[1], s.nodes[2]));
  command(format("create_box %zu box", types));
  for (const Vec3& x : s.x)
    command(format("create_atoms 1 single %.17g %.17g %.17g", x.x, x.y, x.z));
  command("mass * 1");
  command("neighbor 1.0 bin");
  command("neigh_modify every 1 delay 0 check yes");
  command("pair_style " + s.pair);
  command("pair_coeff " + s.pair_coeff);
  if (!s.radii.empty()) {
    std::string drag = "fix drag all hemo/drag " + s.drag;
    for (std::size_t k = 0; k < types; ++k) drag += format(" radius %zu %.17g", k + 1, s.radii[k]);
    command(drag);
  }
  for (const std::string& line : s.forces) command(line);
  if (!s.radii.empty())
    command("fix fluid all hemo/fluid " + s.fluid +
            (plates ? " plates z lower 0 0 0 upper 0 0 0" : ""));
  command("timestep 1.0");
}

void CarrierRun::place(int k, const Vec3& x) {
  command(format("set atom %d x %.17g y %.17g z %.17g", k + 1, x.x, x.y, x.z));
}

std::vector<Vec3> CarrierRun::x() { return lammps::positions(host_.lammps()); }
std::vector<Vec3> CarrierRun::v() { return lammps::velocities(host_.lammps()); }
std::vector<Vec3> CarrierRun::f() { return lammps::forces(host_.lammps()); }

Vec3 CarrierRun::fluid_momentum() { return fluid(host_).momentum(); }

std::vector<Vec3> CarrierRun::fluid_velocity() {
  auto& solver = fluid(host_);
  std::vector<double> rho(solver.block().owned());
  std::vector<Vec3> u(rho.size());
  solver.copy_owned(rho, u);
  return u;
}

int CarrierRun::substeps() {
  return lammps::find_fix<LAMMPS_NS::FixHemoDrag>(&host_.lammps(), "hemo/drag")->substeps();
}

}  // namespace hemomag::app
