#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "app/cell_run.hpp"
#include "app/published.hpp"
#include "app/validation.hpp"
#include "io/figure.hpp"
#include "io/files.hpp"

// One red cell in the fluid: at rest, pulled to a steady state, and let go.

namespace hemomag::app {
namespace {

constexpr int vertices = 642;

// ---- stretched in the fluid against the minimum of the energy

constexpr double stretch_dt = 3.4e-6;  // s; the steady state does not depend on it
constexpr double steady = 1e-3;        // relative change of D_A and D_T over `block` steps
constexpr long block = 10000;
constexpr int most_blocks = 30;
constexpr double steady_tolerance = 0.015;  // relative, of the issue

std::vector<Finding> stretch_in_fluid(const std::string& out) {
  const std::vector<double> forces{25, 50, 100, 200};
  const auto mesh = CellRun::rest_mesh(vertices);
  const membrane::WholeCell network(mesh, table_1());
  const auto expected = stretch(mesh, table_1(), forces, {});
  CellRun cell(out, mesh.x, {.vertices = vertices, .dt = stretch_dt});
  io::make_directory(out);
  io::CsvFile csv(out + "/stretch_in_fluid.csv",
                  "force_pN,time_s,D_A_um,D_T_um,D_z_um,area_change,volume_change,"
                  "D_A_static_um,D_T_static_um");
  std::vector<Finding> found;
  io::Series axial{"in fluid, steady", "#c0392b", {}, {}, {}, io::Series::Style::dots};
  io::Series across = axial;
  io::Series static_A{"least energy", "black", {}, {}, {}, io::Series::Style::line};
  io::Series static_T = static_A;
  for (const Stretched& e : expected) {
    cell.pull(e.force);
    Stretched now = measure(network, cell.x(), e.force);
    double change = 1;
    for (int k = 0; k < most_blocks && change > steady; ++k) {
      const Stretched before = now;
      cell.run(block);
      now = measure(network, cell.x(), e.force);
      change = std::max(std::fabs(now.D_A / before.D_A - 1), std::fabs(now.D_T / before.D_T - 1));
      csv.row({now.force, cell.time(), now.D_A, now.D_T, now.D_z, now.area_change,
               now.volume_change, e.D_A, e.D_T});
    }
    char head[40];
    std::snprintf(head, sizeof head, "%g pN, ", e.force);
    const char* source = "minimum of the same mesh's energy";
    const char* name = "stretch-in-fluid";
    found.push_back(
        {name, std::string(head) + "D_A", now.D_A, e.D_A, steady_tolerance * e.D_A, "um", source});
    found.push_back(
        {name, std::string(head) + "D_T", now.D_T, e.D_T, steady_tolerance * e.D_T, "um", source});
    found.push_back({name, std::string(head) + "last change of either in 10,000 steps", change, 0,
                     steady, "", "steady"});
    axial.x.push_back(e.force), axial.y.push_back(now.D_A);
    across.x.push_back(e.force), across.y.push_back(now.D_T);
    static_A.x.push_back(e.force), static_A.y.push_back(e.D_A);
    static_T.x.push_back(e.force), static_T.y.push_back(e.D_T);
  }
  io::replace_file(out + "/stretch_in_fluid.svg", io::draw_diagrams({{"axial diameter D_A",
                                                                      "force (pN)",
                                                                      "diameter (um)",
                                                                      {axial, static_A},
                                                                      {0, 210},
                                                                      {6, 20}},
                                                                     {"transverse diameter D_T",
                                                                      "force (pN)",
                                                                      "diameter (um)",
                                                                      {across, static_T},
                                                                      {0, 210},
                                                                      {2, 10}}}));
  return found;
}

// ---- at rest

constexpr double rest_dt = 6.8e-6;  // s, as in runs with cell_reynolds = 0.5
constexpr long rest_steps = 10000;
constexpr double rest_round_off = 1e-11;   // relative: some roundings a step over 10,000 steps
constexpr double stretched_by = 1.1;       // along x; as much shorter along y
constexpr double return_tolerance = 0.01;  // relative, of the issue for area and volume

std::vector<Finding> cell_at_rest(const std::string& out) {
  const auto mesh = CellRun::rest_mesh(vertices);
  const membrane::WholeCell network(mesh, table_1());
  const Stretched rest = measure(network, mesh.x, 0);
  std::vector<Finding> found;
  const char* name = "cell-at-rest";
  const char* source = "rest state";
  io::make_directory(out);
  io::CsvFile csv(out + "/cell_at_rest.csv",
                  "stretched_by,time_s,area_change,volume_change,D_A_um,D_T_um,D_z_um");
  io::Diagram extents{"a cell stretched by 10 % comes back", "time (ms)", "change (%)", {}, {}, {}};
  io::Diagram sizes{"its area and volume", "time (ms)", "change (%)", {}, {}, {}};
  for (const double by : {1.0, stretched_by}) {
    std::vector<Vec3> start = mesh.x;
    for (Vec3& p : start) p = {p.x * by, p.y / by, p.z};
    CellRun cell(out, start, {.vertices = vertices, .dt = rest_dt});
    io::Series D_A{"D_A", "#c0392b", {}, {}}, D_T{"D_T", "#1f77b4", {}, {}},
        D_z{"D_z", "black", {}, {}};
    io::Series area{"area", "#c0392b", {}, {}}, volume{"volume", "#1f77b4", {}, {}};
    const auto add = [&](io::Series& s, double relative) {
      s.x.push_back(1e3 * cell.time());
      s.y.push_back(100 * relative);
    };
    Stretched now;
    for (long step = 0; step <= rest_steps; step += 100) {
      if (step > 0) cell.run(100);
      now = measure(network, cell.x(), 0);
      csv.row({by, cell.time(), now.area_change, now.volume_change, now.D_A, now.D_T, now.D_z});
      add(D_A, now.D_A / rest.D_A - 1);
      add(D_T, now.D_T / rest.D_T - 1);
      add(D_z, now.D_z / rest.D_z - 1);
      add(area, now.area_change);
      add(volume, now.volume_change);
    }
    const double worst =
        std::max({std::fabs(now.D_A / rest.D_A - 1), std::fabs(now.D_T / rest.D_T - 1),
                  std::fabs(now.D_z / rest.D_z - 1)});
    const double tolerance = by == 1 ? rest_round_off : return_tolerance;
    const std::string head =
        by == 1 ? "unmoved, 10,000 steps: " : "stretched by 10 %, 10,000 steps later: ";
    found.push_back({name, head + "area", 1 + now.area_change, 1, tolerance, "", source});
    found.push_back({name, head + "volume", 1 + now.volume_change, 1, tolerance, "", source});
    found.push_back({name, head + "worst extent", worst, 0, tolerance, "", source});
    if (by != 1) extents.series = {D_A, D_T, D_z}, sizes.series = {area, volume};
  }
  io::replace_file(out + "/cell_at_rest.svg", io::draw_diagrams({extents, sizes}));
  return found;
}

// ---- let go

constexpr double relax_dt = 1.7e-6;      // s; half of it moves the time to 1/e by 0.2 %
constexpr double relax_pull = 74;        // pN, where length over width is 2, as in the experiment
constexpr double relax_time = 0.1;       // s
constexpr double back_tolerance = 0.02;  // of length over width at the end

/// When the excess of length over width over its rest value `end` has fallen to 1/e.
double recovery_time(const io::Series& s, double end) {
  const double wanted = end + (s.y[0] - end) / std::numbers::e;
  std::size_t i = 1;
  while (i + 1 < s.y.size() && s.y[i] > wanted) ++i;
  const double share = (s.y[i - 1] - wanted) / (s.y[i - 1] - s.y[i]);
  return s.x[i - 1] + share * (s.x[i] - s.x[i - 1]) - s.x[0];
}

std::vector<Finding> relaxation(const std::string& out) {
  const auto mesh = CellRun::rest_mesh(vertices);
  const membrane::WholeCell network(mesh, table_1());
  const auto pulled = stretch(mesh, table_1(), {0, 25, 50, relax_pull}, {});
  CellRun cell(out, pulled.back().x, {.vertices = vertices, .dt = relax_dt});
  io::make_directory(out);
  io::CsvFile csv(out + "/relaxation.csv", "time_s,length_over_width,D_A_um,D_T_um,D_z_um");
  io::Series ours{"hemomag, no membrane viscosity", "#c0392b", {}, {}};
  const auto record = [&] {
    const Stretched s = measure(network, cell.x(), 0);
    csv.row({cell.time(), s.D_A / s.D_T, s.D_A, s.D_T, s.D_z});
    ours.x.push_back(cell.time()), ours.y.push_back(s.D_A / s.D_T);
  };
  record();
  while (cell.time() < relax_time) {
    cell.run(cell.time() < 0.01 ? 100 : 1000);
    record();
  }
  io::Series theirs{"Hochmuth et al. 1979", "black", {}, {}, {}, io::Series::Style::circles};
  for (const auto& p : hochmuth_1979) theirs.x.push_back(p.time), theirs.y.push_back(p.ratio);
  io::replace_file(out + "/relaxation.svg", io::draw_diagrams({{"a cell let go",
                                                                "time (s)",
                                                                "length over width",
                                                                {theirs, ours},
                                                                {0, 0.42},
                                                                {0.9, 2.2}}}));

  const char* name = "relaxation";
  const char* source = "Hochmuth et al. 1979";
  const Stretched rest = measure(network, mesh.x, 0);
  double rise = 0;
  for (std::size_t i = 1; i < ours.y.size(); ++i) rise = std::max(rise, ours.y[i] - ours.y[i - 1]);
  std::vector<Finding> found;
  found.push_back({name, "length over width after 0.1 s", ours.y.back(), rest.D_A / rest.D_T,
                   back_tolerance, "", "rest state"});
  found.push_back({name, "largest rise of length over width on the way", rise, 0, 5e-3, "",
                   "overdamped: falls"});
  found.push_back(
      printed(name, "length over width at the start", ours.y[0], theirs.y[0], "", source));
  for (const auto& p : hochmuth_1979) {
    if (p.time > relax_time) break;
    const auto at = std::lower_bound(ours.x.begin(), ours.x.end(), p.time);
    char quantity[64];
    std::snprintf(quantity, sizeof quantity, "length over width at %.4g s", p.time);
    found.push_back(printed(name, quantity, ours.y[static_cast<std::size_t>(at - ours.x.begin())],
                            p.ratio, "", source));
  }
  found.push_back(printed(name, "time to 1/e (no membrane viscosity: faster)",
                          recovery_time(ours, rest.D_A / rest.D_T), recovery_time(theirs, 1), "s",
                          source));
  return found;
}

}  // namespace

std::vector<Validation> cell_validations() {
  return {{"cell-at-rest", "one cell in fluid keeps and regains its rest shape", cell_at_rest},
          {"stretch-in-fluid", "steady states in fluid against least energy", stretch_in_fluid},
          {"relaxation", "a stretched cell let go in fluid", relaxation}};
}

}  // namespace hemomag::app
