#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <vector>

#include "app/validation.hpp"
#include "case/cells_data.hpp"
#include "case/lattice_units.hpp"
#include "case/placement.hpp"
#include "case/script.hpp"
#include "io/files.hpp"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_watch.h"
#include "lammps/host.hpp"
#include "lammps/positions.hpp"
#include "lattice/triangle_distance.hpp"

// Carriers pressed on a cell that lies on a plate, by the force that a field of 0.2 T exerts at the
// lower plate of a channel 24 um high. Does one get inside?

namespace hemomag::app {
namespace {

using case_::CarrierContact;

constexpr double um = 1e-6;
constexpr double pressed_with = 2.6e-12;  // N, physics of 125 nm carriers at 0.2 T
constexpr int beads = 40;
constexpr long steps = 50000;  // 2,000,000 bead-steps

case_::Case pressed_case(CarrierContact contact, double sigma) {
  case_::Case c;
  c.title = "carriers pressed on a cell";
  c.channel.size = {9 * um, 9 * um, 8 * um};
  c.fluid.viscosity = 1.2e-3;
  c.numerics.dx = 0.5 * um;
  c.numerics.dt = 6.8e-6;
  c.cells.emplace_back();
  c.cells[0].vertices = 642;
  c.cells[0].count = 1;
  c.carriers.emplace_back();
  c.carriers[0].count = beads;
  c.carriers[0].radius = 0.125 * um;
  c.magnetic.dipoles = false;
  c.contact.carrier_contact = contact;
  c.contact.carrier_sigma = sigma;
  c.analysis.layer = 1 * um;
  c.run.steps = 0;
  c.output.series.reset();
  return c;
}

/// The cell flat above the lower plate, carriers over it on a sunflower's spiral of radius 3.2 um.
case_::System over_a_cell(const case_::Case& c) {
  case_::System system;
  system.models = case_::cell_models(c);
  const Vec3 middle{4.5 * um, 4.5 * um, 1.7 * um};
  std::vector<Vec3> x = system.models[0].mesh.x;
  for (Vec3& p : x) p += middle;
  system.cells.push_back({0, x});
  for (int k = 0; k < beads; ++k) {
    const double r = 3.2 * um * std::sqrt((k + 0.5) / beads), turn = 2.399963 * k;
    system.carriers.push_back(
        {0, {{middle.x + r * std::cos(turn), middle.y + r * std::sin(turn), 4.5 * um}}});
  }
  return system;
}

/// Run a case's script but for its last line; `extra` goes before the fluid.
void prepare(lammps::Host& host, const std::string& data, const case_::Case& c,
             const case_::System& system, const std::string& extra) {
  io::replace_file(data, case_::cells_data(c, system));
  const std::string read_data = std::string("read_data \"").append(data).append("\"");
  const std::string script = case_::lammps_script(c, system);
  for (std::size_t at = 0; at < script.size();) {
    const std::size_t end = script.find('\n', at);
    const std::string line = script.substr(at, end - at);
    at = end + 1;
    if (line.rfind("run ", 0) == 0) return;
    if (line.rfind("fix series", 0) == 0) continue;  // no files here
    if (line.rfind("fix fluid ", 0) == 0 && !extra.empty()) host.command(extra);
    host.command(line == "read_data cells.data" ? read_data : line);
  }
}

struct Pressed {
  long inside = 0;     ///< most at one time, looked at every 100 steps
  double nearest = 0;  ///< of a carrier's centre to the cell at the end [um]
};

Pressed press(const std::string& out, CarrierContact contact, double sigma) {
  const case_::Case c = pressed_case(contact, sigma);
  const auto system = over_a_cell(c);
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_SELF);
  char force[96];
  std::snprintf(force, sizeof force, "fix press carriers addforce 0 0 %.12g",
                -pressed_with / case_::lattice_units(c).force());
  prepare(host, out + "/no_leak.data", c, system, force);
  // Those inside are counted here; a user's run would end.
  host.command("unfix watch");
  host.command("fix watch all hemo/watch 100 cells cells carriers carriers");
  host.command("run " + std::to_string(steps) + " post no");
  Pressed p;
  p.inside =
      static_cast<long>(lammps::find_fix<LAMMPS_NS::FixHemoWatch>(&host.lammps(), "hemo/watch")
                            ->record()
                            .carriers_inside_max);
  const auto x = lammps::positions(host.lammps());
  const std::size_t n = system.cells[0].x.size();
  p.nearest = HUGE_VAL;
  for (std::size_t k = n; k < x.size(); ++k)
    for (const auto& t : system.models[0].mesh.triangles) {
      const lattice::Triangle corners{x[std::size_t(t[0])], x[std::size_t(t[1])],
                                      x[std::size_t(t[2])]};
      // Both may have left the box by whole periods of 18 nodes along x and y.
      Vec3 q = x[k];
      for (const std::size_t d : {std::size_t{0}, std::size_t{1}})
        q[d] += 18 * std::round((corners[0][d] - q[d]) / 18);
      p.nearest = std::min(p.nearest, 0.5 * norm(q - lattice::nearest_point(q, corners).x));
    }
  return p;
}

// ---- cost

/// Ms of processor time a step of blood like the demo's, with either contact, in turns.
std::array<double, 2> cost(const std::string& out) {
  std::array<double, 2> least{HUGE_VAL, HUGE_VAL};
  std::vector<std::unique_ptr<lammps::Host>> hosts;
  for (const auto contact : {CarrierContact::vertices, CarrierContact::surface}) {
    case_::Case c = pressed_case(contact, 0.5 * um);
    c.channel.size = {16 * um, 24 * um, 16 * um};
    c.channel.shear_rate = 200;
    c.cells[0].count = 14;
    c.carriers[0].count = 60;
    c.magnetic.dipoles = true;
    c.magnetic.sources.emplace_back();
    hosts.push_back(std::make_unique<lammps::Host>(
        std::vector<std::string>{"-screen", "none", "-log", "none"}, MPI_COMM_SELF));
    prepare(*hosts.back(), out + "/no_leak.data", c, case_::place(c), "");
    hosts.back()->command("run 50 post no");
  }
  constexpr int block = 100, rounds = 4;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < 2; ++k) {
      const std::clock_t start = std::clock();
      hosts[k]->command("run " + std::to_string(block) + " post no");
      const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      least[k] = std::min(least[k], 1e3 * seconds / block);
    }
  return least;
}

std::vector<Finding> no_leak(const std::string& out) {
  io::make_directory(out);
  const char* name = "no-leak";
  std::vector<Finding> found;
  const Pressed surface = press(out, CarrierContact::surface, 0.5 * um);
  found.push_back({name, "2,000,000 bead-steps at 2.6 pN: carriers inside, surface contact",
                   static_cast<double>(surface.inside), 0, 0, "", "issue 6"});
  found.push_back(printed(name, "nearest carrier to the surface at the end, surface contact",
                          surface.nearest, 0.125, "um", "radius of a carrier"));
  for (const double sigma : {0.5, 0.36, 0.25}) {
    const Pressed p = press(out, CarrierContact::vertices, sigma * um);
    char quantity[96];
    std::snprintf(quantity, sizeof quantity, "carriers inside, Lennard-Jones of vertices, %.2f um",
                  sigma);
    found.push_back(printed(name, quantity, static_cast<double>(p.inside), 0, "", "surface"));
    std::snprintf(quantity, sizeof quantity, "nearest carrier at the end, %.2f um", sigma);
    found.push_back(printed(name, quantity, p.nearest, surface.nearest, "um", "surface"));
  }
  const auto ms = cost(out);
  found.push_back(printed(name, "step of 14 cells and 60 carriers with surface contact", ms[1],
                          ms[0], "ms", "with Lennard-Jones"));
  found.push_back(printed(name, "ratio of the two", ms[1] / ms[0], 1, "", "equal cost"));
  return found;
}

}  // namespace

std::vector<Validation> no_leak_validations() {
  return {{"no-leak", "carriers pressed on a cell: none gets inside", no_leak}};
}

}  // namespace hemomag::app
