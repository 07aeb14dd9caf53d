#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <span>

#include "app/validation.hpp"
#include "case/cells_data.hpp"
#include "case/lattice_units.hpp"
#include "case/placement.hpp"
#include "case/script.hpp"
#include "io/figure.hpp"
#include "io/files.hpp"
#include "io/scene.hpp"
#include "lammps/compat.hpp"
#include "lammps/host.hpp"
#include "lammps/positions.hpp"
#include "membrane/mesh.hpp"

// Two red cells face to face, at the distance r0 of the Morse minimum, pulled apart by 7 pN over
// 200 of 3286 vertices (Fig. 6a). The paper holds the lower cell on a substrate; here the same
// force pulls it the other way, which is what a substrate does in a steady state and needs none.
// The well depth D0 at which the cells no longer come apart is what the paper calibrates with the
// test. Lengths in um, D0 in kBT per vertex pair at 3286 vertices.

namespace hemomag::app {
namespace {

constexpr double um = 1e-6, pN = 1e-12;
constexpr double dx = 0.5;     // um
constexpr double dt = 6.8e-6;  // s
constexpr double force = 7;    // pN at each cell
constexpr double pulled_share = 200. / 3286;
constexpr Vec3 box{12, 12, 18};       // um
constexpr double look_every = 2e-3;   // s
constexpr double apart_gap = 1.5;     // um between nearest vertices: the Morse cut-off
constexpr double longest_pull = 0.2;  // s, some 500 relaxation times mu R/mu0

struct Setting {
  double depth;  ///< D0
  int vertices = 642;
};

case_::Case two_cells(const Setting& s) {
  case_::Case c;
  c.title = "two cells";
  c.channel.size = {box.x * um, box.y * um, box.z * um};
  c.channel.boundary = case_::Boundary::periodic;
  c.fluid.viscosity = 1.2e-3;
  c.numerics.dx = dx * um;
  c.numerics.dt = dt;
  c.cells.emplace_back();
  c.cells[0].vertices = s.vertices;
  c.cells[0].count = 2;
  c.contact.morse_depth = s.depth;
  c.contact.cell_sigma = 0.5 * um;  // as in the paper
  c.run.steps = 0;
  c.output.series.reset();
  return c;
}

struct Pulled {
  Setting setting;
  std::vector<double> time, gap, centres;  ///< s; nearest vertices and centres of the cells, um
  std::vector<Vec3> first, last;           ///< vertices of both
  bool apart() const { return gap.back() > apart_gap; }
};

/// Smallest distance between vertices of two sets.
double nearest(std::span<const Vec3> a, std::span<const Vec3> b) {
  double least = HUGE_VAL;
  for (const Vec3& p : a)
    for (const Vec3& q : b) least = std::min(least, norm2(p - q));
  return std::sqrt(least);
}

Vec3 centre(std::span<const Vec3> x) {
  Vec3 sum;
  for (const Vec3& p : x) sum += p / static_cast<double>(x.size());
  return sum;
}

/// The upper cell is the lower one turned over, so that their rims meet vertex to vertex nowhere.
case_::System face_to_face(const case_::Case& c) {
  case_::System system;
  system.models = case_::cell_models(c);
  const auto& rest = system.models[0].mesh.x;
  std::vector<Vec3> lower = rest, upper = rest;
  for (Vec3& p : upper) p = {p.x, -p.y, -p.z};
  // Down until the nearest vertices are r0 apart.
  double far = 4 * um, near = 2 * um;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (far + near);
    for (std::size_t v = 0; v < rest.size(); ++v) upper[v].z = -rest[v].z + middle;
    (nearest(lower, upper) > c.contact.morse_r0 ? far : near) = middle;
  }
  const Vec3 at = 0.5 * um * box - Vec3{0, 0, far / 2};
  for (auto* cell : {&lower, &upper})
    for (Vec3& p : *cell) p += at;
  system.cells.push_back({0, lower});
  system.cells.push_back({0, upper});
  return system;
}

/// `group NAME id` of the vertices of a cell that are farthest along +z or -z, with LAMMPS's tags.
std::string outer_vertices(const char* name, const std::vector<Vec3>& x, double sense,
                           std::size_t first_tag) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return sense * x[a].z > sense * x[b].z; });
  const auto count = std::lround(pulled_share * static_cast<double>(x.size()));
  std::string line = std::string("group ") + name + " id";
  for (long k = 0; k < count; ++k)
    line += " " + std::to_string(first_tag + order[static_cast<std::size_t>(k)]);
  return line;
}

Pulled pull(const std::string& out, const Setting& setting) {
  const case_::Case c = two_cells(setting);
  const auto system = face_to_face(c);
  const std::size_t n = system.cells[0].x.size();
  const std::string data = out + "/separation.data";
  io::replace_file(data, case_::cells_data(c, system));
  const std::string read_data = std::string("read_data \"").append(data).append("\"");
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_SELF);
  const double count = std::round(pulled_share * static_cast<double>(n));
  const double each = force * pN / case_::lattice_units(c).force() / count;
  const std::string script = case_::lammps_script(c, system);
  for (std::size_t at = 0; at < script.size();) {
    const std::size_t end = script.find('\n', at);
    const std::string line = script.substr(at, end - at);
    at = end + 1;
    if (line.rfind("run ", 0) == 0) break;
    if (line.rfind("fix fluid ", 0) == 0) {  // the fluid takes the forces that are there before it
      host.command(outer_vertices("lower", system.cells[0].x, -1, 1));
      host.command(outer_vertices("upper", system.cells[1].x, 1, n + 1));
      char add[96];
      std::snprintf(add, sizeof add, "fix lower lower addforce 0 0 %.17g", -each);
      host.command(add);
      std::snprintf(add, sizeof add, "fix upper upper addforce 0 0 %.17g", each);
      host.command(add);
    }
    host.command(line == "read_data cells.data" ? read_data : line);
  }

  Pulled p{setting, {}, {}, {}, {}, {}};
  const auto look = [&](double time) {
    auto x = lammps::positions(host.lammps());
    for (Vec3& v : x) v *= dx;
    const std::span<const Vec3> all(x);
    p.time.push_back(time);
    p.gap.push_back(nearest(all.first(n), all.subspan(n)));
    p.centres.push_back(centre(all.subspan(n)).z - centre(all.first(n)).z);
    if (p.first.empty()) p.first = x;
    p.last = std::move(x);
  };
  const long steps = std::lround(look_every / dt);
  host.command("run 0 post no");
  look(0);
  while (p.time.back() < longest_pull && !p.apart()) {
    host.command("run " + std::to_string(steps) + " post no");
    look(p.time.back() + static_cast<double>(steps) * dt);
  }
  std::printf("D0 %.4f, %d vertices: gap %.3f um, centres %.3f um after %.3f s\n", setting.depth,
              setting.vertices, p.gap.back(), p.centres.back(), p.time.back());
  std::fflush(stdout);
  return p;
}

std::vector<Finding> separation(const std::string& out) {
  io::make_directory(out);
  std::vector<Pulled> runs;
  for (const double depth : {0.005, 0.01, 0.015}) runs.push_back(pull(out, {depth, 642}));
  return {};
}

}  // namespace

std::vector<Validation> separation_validations() {
  return {{"separation", "two cells pulled apart against their adhesion, Fig. 6a", separation}};
}

}  // namespace hemomag::app
