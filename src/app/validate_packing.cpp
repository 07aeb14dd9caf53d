#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/validation.hpp"
#include "case/packing.hpp"
#include "io/files.hpp"
#include "io/scene.hpp"

// Dense starting states: the figures asked of them, and a picture of the first and the last state
// as in Fig. 6b.

namespace hemomag::app {
namespace {

constexpr double um = 1e-6;
constexpr double minute = 60;

case_::Case channel(int vertices, case_::Placement how) {
  case_::Case c;
  c.title = "packing";
  c.channel.size = {27 * um, 36 * um, 24 * um};
  c.fluid.viscosity = 1.2e-3;
  c.numerics.dx = 0.5 * um;
  c.numerics.dt = 5e-6;
  c.run.steps = 1;
  c.cells.emplace_back();
  c.cells[0].vertices = vertices;
  c.cells[0].placement = how;
  return c;
}

case_::Case tube() {
  case_::Case c = channel(642, case_::Placement::grow);
  c.channel.size = {32 * um, 36 * um, 32 * um};
  c.channel.boundary = case_::Boundary::tube;
  c.channel.diameter = 30 * um;
  c.vessel = case_::make_vessel(c);
  return c;
}

/// The edges of the box [low, high].
std::vector<std::array<std::array<double, 3>, 2>> edges(const std::array<double, 3>& low,
                                                        const std::array<double, 3>& high) {
  std::vector<std::array<std::array<double, 3>, 2>> lines;
  const auto corner = [&](int k) {
    return std::array<double, 3>{k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1],
                                 k & 4 ? high[2] : low[2]};
  };
  for (int k = 0; k < 8; ++k)
    for (const int bit : {1, 2, 4})
      if (!(k & bit)) lines.push_back({corner(k), corner(k | bit)});
  return lines;
}

/// Cells with their centres in the box, in um, in a few shades.
io::Scene scene(const std::string& label, const std::vector<case_::System::PlacedCell>& cells,
                const std::vector<std::array<int, 3>>& triangles, const case_::Case& c,
                double height) {
  static const char* const shades[] = {"#c0392b", "#d35447", "#a93226", "#e07060", "#962d22"};
  io::Scene s;
  s.label = label;
  std::size_t k = 0;
  for (const auto& cell : cells) {
    Vec3 centre;
    for (const Vec3& p : cell.x) centre += p / static_cast<double>(cell.x.size());
    Vec3 home;
    for (std::size_t d = 0; d < 2; ++d)
      home[d] = c.channel.size[d] * std::floor(centre[d] / c.channel.size[d]);
    io::Body body{"", {}, triangles, shades[k++ % 5]};
    for (const Vec3& p : cell.x) {
      const Vec3 q = (p - home) / um;
      body.x.push_back({q.x, q.y, q.z});
    }
    s.bodies.push_back(std::move(body));
  }
  s.lines = edges({0, 0, 0}, {c.channel.size[0] / um, c.channel.size[1] / um, height});
  return s;
}

void draw(const std::string& out, const case_::Case& c, const case_::PackedCells& packed,
          const std::vector<std::array<int, 3>>& triangles) {
  double top = 0;
  for (const auto& cell : packed.first)
    for (const Vec3& p : cell.x) top = std::max(top, p.z / um);
  const double height = c.channel.size[2] / um;
  char first[96], last[96];
  std::snprintf(first, sizeof first, "before: %zu cells in a space %.0f um high",
                packed.first.size(), std::max(2 * height, top));
  std::snprintf(last, sizeof last, "after: %.0f um, hematocrit %.3f", height,
                packed.report.hematocrit);
  io::make_directory(out);
  io::replace_file(out + "/packing.svg",
                   io::draw_scenes({scene(first, packed.first, triangles, c, 2 * height),
                                    scene(last, packed.cells, triangles, c, height)},
                                   {35, 18, 12, 10, "10 um"}));
}

/// What the issue asks of every state.
/// @param most_seconds  0: printed without a gate
void report(std::vector<Finding>& found, const std::string& name, const std::string& state,
            const case_::PackingReport& r, std::size_t cells, double most_seconds) {
  const auto add = [&](const char* what, double measured, double expected, double tolerance,
                       const char* unit, const char* source) {
    found.push_back({name, state + ", " + what, measured, expected, tolerance, unit, source});
  };
  add("cells", static_cast<double>(r.cells), static_cast<double>(cells), 0, "",
      "the nearest to the hematocrit");
  found.push_back(printed(name, state + ", hematocrit", r.hematocrit, r.hematocrit, "",
                          "rest volumes over the fluid's"));
  add("crossing pairs of triangles", static_cast<double>(r.crossings), 0, 0, "",
      "exact test of all pairs");
  // Above zero is what is asked; half the range is where the repulsion should leave it.
  add("smallest gap", r.smallest_gap / um, 0.2, 0.15, "um", "above 0; repulsion of 0.2 um");
  add("area, largest change", r.area_change, 0, 0.01, "", "1 %");
  add("volume, largest change", r.volume_change, 0, 0.01, "", "1 %");
  if (most_seconds > 0)
    add("time", r.seconds, 0, most_seconds, "s", "on 2 cores, of which it uses one");
  else
    found.push_back(printed(name, state + ", time", r.seconds, r.seconds, "s", "no figure asked"));
}

std::vector<Finding> packing(const std::string& out) {
  std::vector<Finding> found;
  case_::Case c = channel(642, case_::Placement::compress);
  c.cells[0].hematocrit = 0.30;
  const auto models = case_::cell_models(c);
  const auto packed = case_::pack_cells(c, models);
  draw(out, c, packed, models[0].mesh.triangles);
  report(found, "packing", "compressed, 642 vertices, Ht 0.30", packed.report, 74, 5 * minute);

  c = tube();
  c.cells[0].hematocrit = 0.30;
  report(found, "packing", "grown in a tube of 30 um, Ht 0.30",
         case_::pack_cells(c, case_::cell_models(c)).report, 81, 0);
  return found;
}

std::vector<Finding> packing_dense() {
  std::vector<Finding> found;
  case_::Case c = channel(642, case_::Placement::compress);
  c.cells[0].hematocrit = 0.45;
  report(found, "packing-dense", "compressed, 642 vertices, Ht 0.45",
         case_::pack_cells(c, case_::cell_models(c)).report, 112, 20 * minute);
  c.cells[0].placement = case_::Placement::grow;
  report(found, "packing-dense", "grown, 642 vertices, Ht 0.45",
         case_::pack_cells(c, case_::cell_models(c)).report, 112, 20 * minute);
  return found;
}

std::vector<Finding> packing_fine() {
  std::vector<Finding> found;
  case_::Case c = channel(3286, case_::Placement::compress);
  for (const int count : {40, 74}) {
    c.cells[0].count = count;
    report(found, "packing-fine", std::to_string(count) + " cells of 3286 vertices",
           case_::pack_cells(c, case_::cell_models(c)).report, static_cast<std::size_t>(count), 0);
  }
  return found;
}

}  // namespace

std::vector<Validation> packing_validations() {
  return {
      {"packing", "dense starting states: Ht 0.30 between plates (Fig. 6b) and in a tube", packing},
      {"packing-dense", "Ht 0.45 between plates, compressed and grown", packing_dense},
      {"packing-fine", "40 and 74 cells of 3286 vertices", packing_fine}};
}

}  // namespace hemomag::app
