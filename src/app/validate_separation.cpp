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
// test. Vertices move by friction alone, without a fluid: the film between the cells would drain
// for seconds, and whether they come apart is a question of forces, not of its speed. Lengths in
// um, D0 in kBT per vertex pair at 3286 vertices, time in LAMMPS's lattice units.

namespace hemomag::app {
namespace {

constexpr double um = 1e-6, pN = 1e-12;
constexpr double dx = 0.5;     // um
constexpr double dt = 6.8e-6;  // s, sets the unit of force
constexpr double force = 7;    // pN at each cell
constexpr double pulled_share = 200. / 3286;
constexpr Vec3 box{12, 12, 18};  // um
// Vertices have mass one and a friction that lets a free pair drift apart by a node in 1,000.
constexpr double step = 0.25;         // of time, lattice units
constexpr long look_every = 500;      // steps
constexpr long longest_pull = 60000;  // steps
constexpr double drift = 1e-3;        // speed of a free cell under the pull, nodes a time
constexpr double at_rest = 2e-3;      // part of that speed below which the pair holds
constexpr double apart_gap = 1.5;     // um between nearest vertices: the Morse cut-off

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
  std::vector<double> time, gap, centres;  ///< nearest vertices and centres of the cells, um
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
  std::string line = std::string("group ").append(name).append(" id");
  for (long k = 0; k < count; ++k)
    line.append(" ").append(std::to_string(first_tag + order[static_cast<std::size_t>(k)]));
  return line;
}

void command(lammps::Host& host, const char* format, double value) {
  char line[96];
  std::snprintf(line, sizeof line, format, value);
  host.command(line);
}

/// Lines of a case's script that only mean something with a fluid.
bool needs_fluid(const std::string& line) {
  for (const char* start : {"fix ", "timestep ", "thermo_style "})
    if (line.rfind(start, 0) == 0) return true;
  return false;
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
    if (!needs_fluid(line)) host.command(line == "read_data cells.data" ? read_data : line);
  }

  host.command("timestep " + std::to_string(step));
  host.command(outer_vertices("lower", system.cells[0].x, -1, 1));
  host.command(outer_vertices("upper", system.cells[1].x, 1, n + 1));
  command(host, "fix lower lower addforce 0 0 %.12g", -each);
  command(host, "fix upper upper addforce 0 0 %.12g", each);
  host.command("fix move all nve");
  command(host, "fix friction all viscous %.12g", each * count / (static_cast<double>(n) * drift));

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
  host.command("run 0 post no");
  look(0);
  bool moves = true;
  for (long at = look_every; at <= longest_pull && moves && !p.apart(); at += look_every) {
    host.command("run " + std::to_string(look_every) + " post no");
    look(static_cast<double>(at) * step);
    const double moved = p.centres.back() - p.centres[p.centres.size() - 2];
    moves = at < 20 * look_every ||
            std::fabs(moved) > at_rest * 2 * drift * dx * step * static_cast<double>(look_every);
  }
  std::printf("D0 %.4f, %d vertices: gap %.3f um, centres %.3f um after %.0f\n", setting.depth,
              setting.vertices, p.gap.back(), p.centres.back(), p.time.back());
  std::fflush(stdout);
  return p;
}

/// The D0 between `apart` and `adhering` at which pairs no longer come apart, to `width`.
double threshold(const std::string& out, int vertices, double apart, double adhering,
                 double width) {
  while (adhering - apart > width) {
    const double middle = 0.5 * (apart + adhering);
    (pull(out, {middle, vertices}).apart() ? apart : adhering) = middle;
  }
  return 0.5 * (apart + adhering);
}

std::string label(const Setting& s) {
  char text[64];
  std::snprintf(text, sizeof text, "D0 = %.3g kBT, %d", s.depth, s.vertices);
  return text;
}

void draw(const std::string& out, const std::vector<Pulled>& runs) {
  const char* colours[] = {"#1f77b4", "#c0392b", "#2e8b57"};  // by D0
  io::Diagram diagram{"two cells pulled apart with 7 pN",
                      "time in which a free cell drifts 0.5 nm",
                      "distance of the centres (um)",
                      {},
                      {},
                      {}};
  io::CsvFile csv(out + "/separation.csv", "D0_kBT,vertices,time,gap_um,centres_um");
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Pulled& p = runs[k];
    diagram.series.push_back(
        {label(p.setting),
         colours[k % std::size(colours)],
         p.time,
         p.centres,
         {},
         p.setting.vertices == 642 ? io::Series::Style::dashes : io::Series::Style::line});
    for (std::size_t i = 0; i < p.time.size(); ++i)
      csv.row({p.setting.depth, double(p.setting.vertices), p.time[i], p.gap[i], p.centres[i]});
  }
  io::replace_file(out + "/separation_6a.svg", io::draw_diagrams({diagram}));

  std::vector<io::Scene> scenes;
  const auto scene = [&](const Pulled& p, const std::vector<Vec3>& x, const char* when) {
    const auto triangles = case_::cell_models(two_cells(p.setting))[0].mesh.triangles;
    const std::size_t n = x.size() / 2;
    char title[64];
    std::snprintf(title, sizeof title, "%.3g kBT, %s", p.setting.depth, when);
    io::Scene s{title, {}, {}};
    for (std::size_t cell = 0; cell < 2; ++cell) {
      io::Body body;
      for (std::size_t v = 0; v < n; ++v) {
        const Vec3 q = x[cell * n + v] - 0.5 * box;
        body.x.push_back({q.x, q.y, q.z});
      }
      body.triangles = triangles;
      body.colour = cell == 0 ? "#c0392b" : "#e67e22";
      s.bodies.push_back(std::move(body));
    }
    scenes.push_back(std::move(s));
  };
  for (const Pulled& p : runs) {
    if (p.setting.vertices == 642) continue;
    if (scenes.empty()) scene(p, p.first, "start");
    scene(p, p.last, p.apart() ? "apart" : "adhering");
  }
  io::View view;
  view.tilt = 10;
  view.scale = 20;
  view.bar = 5;
  view.bar_label = "5 um";
  io::replace_file(out + "/separation_cells.svg", io::draw_scenes(scenes, view));
}

std::vector<Finding> separation(const std::string& out) {
  io::make_directory(out);
  const char* name = "separation";
  std::vector<Finding> found;
  std::vector<Pulled> runs;
  for (const int vertices : {642, 3286})
    for (const double depth : {0.03, 0.04, 0.05}) {
      runs.push_back(pull(out, {depth, vertices}));
      if (depth == 0.05) continue;  // for the figure
      char quantity[96];
      std::snprintf(quantity, sizeof quantity, "D0 %.2f kBT, %d vertices: pairs that come apart",
                    depth, vertices);
      Finding f{name, quantity, double(runs.back().apart()), double(depth < 0.035),
                0,    "",       "Ye, Shen & Li 2018, 3.1.3"};
      // The coarser mesh has its D0 rescaled. The finer one lets go at 0.04 too, slowly: its
      // threshold is 0.041, and what the paper's pair stood on or for how long is not given.
      if (vertices == 642)
        f.kind = Finding::Kind::printed;
      else if (depth == 0.04)
        f.kind = Finding::Kind::shortfall;
      found.push_back(f);
    }
  constexpr double coarse_scale = (3286. / 642) * (3286. / 642), width = 0.00125;
  const double coarse = threshold(out, 642, 0.03, 0.05, width);
  const double fine = threshold(out, 3286, 0.03, 0.05, width);
  const char* paper = "Ye, Shen & Li 2018: 0.03 to 0.04";
  found.push_back(
      printed(name, "D0 at which 3286-vertex pairs begin to hold", fine, 0.035, "kBT", paper));
  found.push_back(printed(name, "D0 at which 642-vertex pairs begin to hold, at 3286 vertices",
                          coarse, 0.035, "kBT", paper));
  found.push_back(printed(name, "the same per pair of vertices of that mesh", coarse * coarse_scale,
                          0.035 * coarse_scale, "kBT", "rescaled, (3286/642)^2"));
  draw(out, runs);
  return found;
}

}  // namespace

std::vector<Validation> separation_validations() {
  return {{"separation", "two cells pulled apart against their adhesion, Fig. 6a", separation}};
}

}  // namespace hemomag::app
