#include "case/case_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "case/cell_model.hpp"
#include "case/keys.hpp"
#include "case/lattice_units.hpp"
#include "case/overrides.hpp"
#include "case/packed_file.hpp"
#include "case/read_magnetic.hpp"
#include "case/toml_table.hpp"
#include "case/vessel.hpp"
#include "io/files.hpp"

namespace hemomag::case_ {
namespace {

constexpr double default_profiles = 5e-3;  // s, between plates
constexpr double most_nodes = 2e9;
constexpr std::uintmax_t largest_case = 10'000'000;  // bytes
constexpr const char* whole_surface = "a whole STL, OFF or PLY file of a closed surface";

std::string read_text(const std::string& path) {
  const bool readable = io::is_readable(path);
  if (readable && std::filesystem::file_size(path) > largest_case)
    throw CaseError(path + ":1:1: file: has more than 10 MB; a TOML file is expected");
  std::ifstream file;
  if (readable) file.open(path);
  std::stringstream text;
  text << file.rdbuf();
  if (!readable || file.bad())
    throw CaseError(path + ":1:1: file: cannot be read; a readable TOML file is expected");
  return text.str();
}

toml::table parse(const std::string& text, const std::string& path) {
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& e) {
    throw CaseError(path + ":" + std::to_string(e.source().begin.line) + ":" +
                    std::to_string(e.source().begin.column) +
                    ": syntax: " + std::string(e.description()) + "; a TOML file is expected");
  }
}

Boundary boundary(const std::string& word) {
  return word == "plates"     ? Boundary::plates
         : word == "periodic" ? Boundary::periodic
         : word == "tube"     ? Boundary::tube
                              : Boundary::voxels;
}

/// What drives the fluid: moving plates, a body force, or a mean velocity.
void read_drive(Case& c, const Table& t) {
  auto& channel = c.channel;
  channel.shear_rate = t.optional_quantity("shear_rate").value_or(0);
  if (channel.boundary != Boundary::plates && channel.shear_rate > 0)
    t.fail("shear_rate", "needs moving plates; accepted: boundary = \"plates\", or no shear_rate");
  channel.body_force[static_cast<std::size_t>(channel.axis)] =
      t.optional_quantity("body_force").value_or(0);
  channel.mean_velocity = t.optional_quantity("mean_velocity");
  if (!channel.mean_velocity) return;
  for (const char* other : {"body_force", "shear_rate"})
    if (t.has(other))
      t.fail("mean_velocity", std::string("excludes ") + other + "; accepted: one of the two");
  if (channel.boundary == Boundary::periodic)
    t.fail("mean_velocity",
           "needs walls that resist the flow; accepted: boundary = \"plates\", \"tube\" or "
           "\"voxels\"");
}

void read_channel(Case& c, const Table& t) {
  t.require("size");
  auto& channel = c.channel;
  channel.size = t.vector("size");
  channel.boundary = boundary(t.word("boundary"));
  channel.plates = t.word("plates") == "lower-rest" ? Plates::lower_rest : Plates::symmetric;
  channel.axis = t.word("axis")[0] - 'x';
  if (in_vessel(c))
    t.refuse_if_given("plates", "means nothing in a tube or voxels; accepted: leave it out");
  else
    t.refuse_if_given("axis", "is for a tube or voxels, elsewhere the flow is along y; accepted: "
                              "boundary = \"tube\" or \"voxels\", or leave it out");
  if (channel.boundary == Boundary::tube)
    t.require("diameter");
  else
    t.refuse_if_given("diameter", "needs boundary = \"tube\"; accepted: that, or leave it out");
  channel.diameter = t.optional_quantity("diameter").value_or(0);
  if (channel.boundary == Boundary::voxels)
    t.require("geometry");
  else
    for (const char* key : {"geometry", "geometry_unit"})
      t.refuse_if_given(key, "needs boundary = \"voxels\"; accepted: that, or leave it out");
  channel.geometry_unit = t.quantity("geometry_unit");
  read_drive(c, t);
}

void check_size(const Case& c, const Table& channel) {
  for (std::size_t d = 0; d < 3; ++d) {
    const double nodes = c.channel.size[d] / c.numerics.dx;
    if (std::fabs(nodes - std::round(nodes)) > 1e-9 * nodes || nodes < 4 || nodes > 1e6) {
      char text[160];
      std::snprintf(text, sizeof text,
                    "%g um along %c is %.9g dx; accepted: a whole multiple of dx, at least 4",
                    c.channel.size[d] * 1e6, "xyz"[d], nodes);
      channel.fail("size", text);
    }
  }
  double total = 1;
  for (const int n : nodes(c)) total *= n;
  if (total <= most_nodes) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "is a box of %.3g nodes; accepted: at most %.3g, which take 420 GB (see "
                "numerics.dx)",
                total, most_nodes);
  channel.fail("size", text);
}

/// Beyond these, numbers of other units leave what doubles hold.
void check_time_step(const Case& c, const Table& t) {
  constexpr double shortest = 1e-15, longest = 1;
  const double dt = lattice_units(c).dt;
  if (dt >= shortest && dt <= longest) return;
  char text[120];
  std::snprintf(text, sizeof text, "gives steps of %.3g s; accepted: from %g s to %g s", dt,
                shortest, longest);
  t.fail(t.has("dt") ? "dt" : "cell_reynolds", text);
}

/// tau and dx leave one freedom: the time step, by one of three keys.
void read_time_step(Case& c, const Table& t) {
  auto& n = c.numerics;
  if (t.has("dt") && t.has("cell_reynolds"))
    t.fail("dt", "excludes cell_reynolds; accepted: one of the two");
  n.dt = t.optional_quantity("dt");
  if (n.dt || t.is_word("cell_reynolds", "true")) return check_time_step(c, t);
  if (nominal_shear_rate(c) > 0)
    n.cell_reynolds = t.number("cell_reynolds");
  else if (t.has("cell_reynolds"))
    t.fail("cell_reynolds",
           "means nothing without channel.shear_rate or channel.mean_velocity; accepted: "
           "numerics.dt, or cell_reynolds = \"true\"");
  else
    t.missing("dt", "is missing; without channel.shear_rate or channel.mean_velocity a time step "
                    "is required, e.g. \"6.81 us\"");
  check_time_step(c, t);
}

void read_numerics(Case& c, const Table& t) {
  auto& n = c.numerics;
  n.tau = t.number("tau");
  n.scheme = t.word("scheme");
  if (n.scheme != "exponential" && n.tau <= 0.5)
    t.fail("tau",
           "is out of range; accepted: above 0.5 and at most 100, or from 0.05 with scheme = "
           "\"exponential\"");
  n.precision = t.word("precision");
  n.kernel = t.word("kernel");
  read_time_step(c, t);
}

/// The path of a file that a key names relative to the case file.
/// @throws CaseError at the key when it cannot be read
std::string surface_path(const Table& t, const char* key, const std::string& case_path) {
  std::string path = (std::filesystem::path(case_path).parent_path() / t.word(key)).string();
  if (!io::is_readable(path))
    t.fail(key, path + ": cannot be read; a readable STL, OFF or PLY file is expected");
  return path;
}

/// The wall of a tube or of voxels, made here so that a surface that cannot be used is refused with
/// its place.
void read_vessel(Case& c, const Table& channel, const std::string& case_path) {
  if (c.channel.boundary == Boundary::tube)
    for (std::size_t d = 0; d < 3; ++d) {
      const double room = c.channel.size[d] - 2 * c.numerics.dx;
      if (static_cast<int>(d) == c.channel.axis || c.channel.diameter <= room * (1 + 1e-12))
        continue;
      char text[160];
      std::snprintf(text, sizeof text,
                    "is too wide for the box along %c; accepted: at most %g um, which leaves a "
                    "node spacing to each side",
                    "xyz"[d], room * 1e6);
      channel.fail("diameter", text);
    }
  if (c.channel.boundary == Boundary::voxels)
    c.channel.geometry = surface_path(channel, "geometry", case_path);
  try {
    c.vessel = make_vessel(c);
  } catch (const Error& e) {
    channel.fail_reading("geometry", e.what(), whole_surface);
  }
}

void read_cell_mesh(Cell& cell, const Table& t, const std::string& case_path) {
  t.refuse_if_given("vertices", "excludes mesh, which has its own; accepted: one of the two");
  for (const char* key : {"diameter", "thickness"})
    t.refuse_if_given(key, "excludes mesh, whose size mesh_unit sets; accepted: leave it out");
  cell.mesh = surface_path(t, "mesh", case_path);
  try {
    cell.surface = read_cell_surface(cell.mesh);
  } catch (const Error& e) {
    t.fail_reading("mesh", e.what(), whole_surface);
  }
  cell.vertices = static_cast<int>(cell.surface->points.size());
  cell.mesh_unit = t.quantity("mesh_unit");
}

void read_cell_size(Cell& cell, const Table& t) {
  t.refuse_if_given("mesh_unit", "needs mesh = \"FILE\"; accepted: that, or leave it out");
  if (cell.kind == CellKind::rbc)
    t.refuse_if_given("diameter", "is for platelets and white cells, a red cell has 7.82 um; "
                                  "accepted: another kind, or leave it out");
  if (cell.kind != CellKind::platelet)
    t.refuse_if_given("thickness", "is for platelets; accepted: kind = \"platelet\", or leave it "
                                   "out");
  if (t.has("vertices")) cell.vertices = static_cast<int>(t.number("vertices"));
  if (t.has("diameter")) cell.diameter = t.quantity("diameter");
  if (t.has("thickness")) cell.thickness = t.quantity("thickness");
  if (cell.kind != CellKind::platelet) return;
  const double ratio = cell.thickness / cell.diameter;
  if (ratio >= least_thickness * (1 - 1e-12) && ratio <= 1 + 1e-12) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "%s%g um, out of range; accepted: at least %g um and at most the diameter, %g um",
                t.has("thickness") ? "is " : "leaves the thickness at ", cell.thickness * 1e6,
                least_thickness * cell.diameter * 1e6, cell.diameter * 1e6);
  t.fail(t.has("thickness") ? "thickness" : "diameter", text);
}

void read_cell_count(Cell& cell, const Table& t) {
  if (t.has("count") && t.has("hematocrit"))
    t.fail("count", "excludes hematocrit; accepted: one of the two");
  if (cell.kind != CellKind::rbc && !t.has("count") && !t.has("hematocrit"))
    t.missing("count", "is missing; count or hematocrit is required but for red cells");
  if (t.has("count"))
    cell.count = static_cast<int>(t.number("count"));
  else
    cell.hematocrit = t.number("hematocrit");
}

void read_placement(Cell& cell, const Table& t, const std::string& case_path) {
  if (t.has("placement") && t.node("placement").is_table()) {
    const toml::table& file = *t.node("placement").as_table();
    const auto name = file["file"].value<std::string>();
    if (!name || file.size() != 1)
      t.fail("placement", "is a table of other than a file; accepted: { file = \"packed.data\" }");
    cell.placement = Placement::file;
    cell.packed = (std::filesystem::path(case_path).parent_path() / *name).string();
    if (!io::is_readable(cell.packed))
      t.fail("placement",
             cell.packed + ": cannot be read; accepted: a state that hemomag pack wrote");
    return;
  }
  const std::string how = t.word("placement");
  cell.placement = how == "grid"       ? Placement::grid
                   : how == "compress" ? Placement::compress
                   : how == "grow"     ? Placement::grow
                                       : Placement::random;
}

/// Packing is of all cells at once, and plates compress between plates only.
void check_placements(const Case& c, const std::vector<Table>& tables) {
  for (std::size_t k = 0; k < c.cells.size(); ++k) {
    const Placement how = c.cells[k].placement, first = c.cells[0].placement;
    if (how != first && std::max(how, first) >= Placement::compress) {
      const char* problem =
          "differs from another [[cell]]; accepted: the same for all where one is "
          "packed (compress, grow or a file)";
      if (tables[k].has("placement")) tables[k].fail("placement", problem);
      tables[k].missing("placement", problem);
    }
    if (how == Placement::compress && c.channel.boundary != Boundary::plates)
      tables[k].fail("placement", "\"compress\" drives two plates together and needs boundary = "
                                  "\"plates\"; accepted: \"grow\"");
    if (how == Placement::file && c.cells[k].packed != c.cells[0].packed)
      tables[k].fail("placement", "names another file than the first [[cell]]; accepted: one file "
                                  "for all");
  }
}

Cell read_cell(const Table& t, const std::string& case_path) {
  const std::string kind = t.word("kind");
  Cell cell = standard_cell(kind == "platelet" ? CellKind::platelet
                            : kind == "white"  ? CellKind::white
                                               : CellKind::rbc);
  if (t.has("mesh"))
    read_cell_mesh(cell, t, case_path);
  else
    read_cell_size(cell, t);
  read_cell_count(cell, t);
  if (cell.kind != CellKind::rbc || cell.surface)
    t.refuse_if_given("stress_free", "is for red cells without a mesh of their own, others are at "
                                     "rest as they are; accepted: leave it out");
  if (t.word("stress_free") == "sphere") cell.stress_free = StressFree::sphere;
  read_placement(cell, t, case_path);
  cell.hinges = t.word("hinges") == "flat" ? Hinges::flat : Hinges::rest;
  if (t.has("shear_modulus")) cell.shear_modulus = t.quantity("shear_modulus");
  if (t.has("bending_modulus")) cell.bending_modulus = t.quantity("bending_modulus");
  cell.area_modulus_local = t.quantity("area_modulus_local");
  cell.area_modulus_global = t.quantity("area_modulus_global");
  cell.volume_modulus = t.quantity("volume_modulus");
  cell.stretch_ratio = t.number("stretch_ratio");
  return cell;
}

Carrier read_carrier(const Table& t, double fluid_density) {
  Carrier carrier;
  carrier.kind = t.word("kind") == "worm" ? CarrierKind::worm : CarrierKind::particle;
  for (const char* key : {"beads", "stretching", "bending"})
    if (carrier.kind == CarrierKind::particle && t.has(key))
      t.fail(key, "is for worms; accepted: kind = \"worm\", or leave it out");
  carrier.count = static_cast<int>(t.number("count"));
  carrier.beads = static_cast<int>(t.number("beads"));
  carrier.stretching = t.quantity("stretching");
  carrier.bending = t.quantity("bending");
  carrier.radius = t.quantity("radius");
  carrier.susceptibility = t.number("susceptibility");
  carrier.magnetic_fraction = t.number("magnetic_fraction");
  carrier.density = t.optional_quantity("density");
  carrier.saturation_magnetisation = t.optional_quantity("saturation_magnetisation").value_or(0);
  if (carrier.susceptibility <= 0)
    t.refuse_if_given("saturation_magnetisation", "needs a susceptibility above 0; accepted: that, "
                                                  "or leave it out");
  carrier.feedback = t.flag("feedback");
  if (carrier.density && carrier.feedback && *carrier.density < fluid_density)
    t.fail("density", "is below the fluid's, whose mass is already there; accepted: at least "
                      "fluid.density, or feedback = false");
  return carrier;
}

/// A unit that was mistaken shows here, before neighbour lists of all with all are made.
void check_ranges(const Case& c, const Table& t) {
  const auto& size = c.channel.size;
  const double longest = std::min({size[0], size[1], size[2]}) / 2;
  for (const char* key :
       {"morse_r0", "morse_cutoff", "cell_sigma", "carrier_sigma", "surface_range", "plate_sigma"})
    if (t.has(key) && t.quantity(key) > longest) {
      char text[120];
      std::snprintf(text, sizeof text, "reaches across the channel; accepted: at most %.4g um here",
                    longest * 1e6);
      t.fail(key, text);
    }
  if (c.contact.morse_depth > 0 && c.contact.morse_cutoff <= c.contact.morse_r0)
    t.fail("morse_cutoff", "does not reach the well's minimum; accepted: above morse_r0, or "
                           "morse_depth = 0");
}

void read_contact(Case& c, const Table& t) {
  c.contact.morse_depth = t.number("morse_depth");
  c.contact.morse_beta = t.quantity("morse_beta");
  c.contact.morse_r0 = t.quantity("morse_r0");
  c.contact.morse_cutoff = t.quantity("morse_cutoff");
  c.contact.cell_sigma = t.optional_quantity("cell_sigma");
  c.contact.carrier_sigma = t.quantity("carrier_sigma");
  c.contact.carrier_contact =
      t.word("carrier_contact") == "surface" ? CarrierContact::surface : CarrierContact::vertices;
  const bool surface = c.contact.carrier_contact == CarrierContact::surface;
  for (const char* key : {"surface_range", "surface_stiffness"})
    if (!surface)
      t.refuse_if_given(key,
                        "needs carrier_contact = \"surface\"; accepted: that, or leave it out");
  if (surface)
    t.refuse_if_given("carrier_sigma",
                      "is for carrier_contact = \"vertices\"; accepted: that, or leave it out");
  c.contact.surface_range = t.quantity("surface_range");
  c.contact.surface_stiffness = t.quantity("surface_stiffness");
  c.contact.epsilon = t.number("epsilon");
  c.contact.plate_sigma = t.quantity("plate_sigma");
  c.contact.repulsion = t.word("repulsion") == "soft" ? Repulsion::soft : Repulsion::paper;
  if (c.contact.repulsion == Repulsion::paper && t.has("repulsion_kappa"))
    t.fail("repulsion_kappa", "is of the soft repulsion; accepted: repulsion = \"soft\", or leave "
                              "it out");
  c.contact.repulsion_kappa = t.number("repulsion_kappa");
  check_ranges(c, t);
}

void read_analysis(Case& c, const Table& t) {
  auto& analysis = c.analysis;
  analysis.measured = t.is_word("layer", "measured");
  if (analysis.measured && (c.channel.boundary != Boundary::plates || c.cells.empty()))
    t.fail("layer", "\"measured\" needs plates and a [[cell]]; accepted: those, or a length");
  if (!analysis.measured) {
    t.refuse_if_given("layer_run", "needs layer = \"measured\"; accepted: that, or leave it out");
    analysis.layer = t.quantity("layer");
  }
  analysis.layer_run = t.quantity("layer_run");
  if (in_vessel(c) && analysis.layer >= width(c) / 2)
    t.fail("layer", "is thicker than the vessel; accepted: less than half its width");
  if (analysis.layer >= c.channel.size[2])
    t.fail("layer", "is thicker than the channel; accepted: less than its height");
  const std::string walls = t.word("walls");
  analysis.walls = in_vessel(c)       ? LayerWalls::vessel
                   : walls == "lower" ? LayerWalls::lower
                                      : LayerWalls::both;
  if (in_vessel(c) && walls != "vessel")
    t.refuse_if_given("walls", "is for plates; accepted in a tube or voxels: \"vessel\"");
  if (!in_vessel(c) && walls == "vessel")
    t.fail("walls", "needs a tube or voxels; accepted: \"lower\", \"both\"");
  if (analysis.walls == LayerWalls::both && !analysis.measured &&
      2 * analysis.layer >= c.channel.size[2])
    t.fail("layer", "at both plates leaves nothing between; accepted: less than half the height, "
                    "or walls = \"lower\"");
}

void check_steps(const Case& c, const Table& run) {
  const double steps =
      c.run.time ? *c.run.time / lattice_units(c).dt : static_cast<double>(*c.run.steps);
  if (steps <= most_steps) return;
  char text[120];
  std::snprintf(text, sizeof text, "makes %.4g steps; accepted: at most %ld of them", steps,
                most_steps);
  run.fail(c.run.time ? "time" : "steps", text);
}

void read_run(Case& c, const Table& run, const Table& analysis) {
  if (run.has("time") && run.has("steps"))
    run.fail("steps", "excludes time; accepted: one of the two");
  if (!run.has("time") && !run.has("steps"))
    run.missing("time", "is missing; time (e.g. \"1.4 s\") or steps is required");
  c.run.time = run.optional_quantity("time");
  if (run.has("steps")) c.run.steps = static_cast<long>(run.number("steps"));
  check_steps(c, run);
  if (run.is_word("checkpoint", "never"))
    c.run.checkpoint.reset();
  else
    c.run.checkpoint = run.quantity("checkpoint");
  if (c.analysis.measured && c.analysis.layer_run / lattice_units(c).dt > most_steps)
    analysis.fail("layer_run", "makes more than 2147483647 steps; accepted: a shorter time");
  c.analysis.average_from = analysis.quantity("average_from");
  const double duration =
      c.run.time ? *c.run.time : static_cast<double>(*c.run.steps) * lattice_units(c).dt;
  if (!analysis.has("average_from") && duration <= c.analysis.average_from)
    c.analysis.average_from = 0;
}

void read_output(Case& c, const Table& t) {
  c.output.fields = t.is_word("fields", "never") ? std::nullopt : t.optional_quantity("fields");
  c.output.series = t.is_word("series", "never") ? std::nullopt : t.optional_quantity("series");
  c.output.cells = !t.has("cells")               ? c.output.fields
                   : t.is_word("cells", "never") ? std::nullopt
                                                 : t.optional_quantity("cells");
  const bool plates = c.channel.boundary == Boundary::plates;
  if (!plates && !t.is_word("profiles", "never"))
    t.refuse_if_given("profiles", "needs boundary = \"plates\"; accepted: that, or \"never\"");
  if (t.is_word("profiles", "never") || !plates)
    c.output.profiles.reset();
  else
    c.output.profiles = t.optional_quantity("profiles").value_or(default_profiles);
}

/// Every key's place, for messages that come after reading.
void note_positions(Case& c, const Source& source, const toml::node& node,
                    const std::string& path) {
  if (!path.empty())
    c.positions[path] = source.overridden.contains(&node) ? "--set" : source.place(node);
  if (const auto* table = node.as_table())
    for (const auto& [name, value] : *table)
      note_positions(c, source, value, (path.empty() ? "" : path + ".") + std::string(name.str()));
  if (const auto* list = node.as_array(); list && list->is_array_of_tables())
    for (std::size_t k = 0; k < list->size(); ++k)
      note_positions(c, source, *list->get(k), entry_path(path.c_str(), k, list->size()));
}

/// Entries that are all of count 0 are as if they were not there.
template <class Entry>
bool drop_if_none(std::vector<Entry>& entries, Source& source, const char* name) {
  const auto none = [](const Entry& e) { return e.count == 0; };
  if (entries.empty() || !std::all_of(entries.begin(), entries.end(), none)) return false;
  entries.clear();
  source.root.erase(name);
  return true;
}

/// The case as run: overrides applied, and surfaces where the run directory keeps its copies.
/// @param text  of the file, or nothing when it no longer says what is run
std::string effective_text(Source& source, const Case& c, const std::string& text) {
  bool copies = false;
  if (const std::string copy = geometry_copy(c); !copy.empty()) {
    source.root["channel"].as_table()->insert_or_assign("geometry", copy);
    copies = true;
  }
  for (std::size_t k = 0; k < c.cells.size(); ++k)
    if (const std::string copy = mesh_copy(c, k); !copy.empty()) {
      source.root["cell"][k].as_table()->insert_or_assign("mesh", copy);
      copies = true;
    }
  copies = point_at_table_copies(source, c) || copies;
  for (std::size_t k = 0; k < c.cells.size(); ++k)
    if (c.cells[k].placement == Placement::file) {
      source.root["cell"][k].as_table()->insert_or_assign("placement",
                                                          toml::table{{"file", packed_copy}});
      copies = true;
    }
  if (!copies && source.overridden.empty() && !text.empty()) return text;
  std::stringstream out;
  out << source.root << "\n";
  return out.str();
}

}  // namespace

std::string position(const Case& c, std::string key) {
  const std::string full = key;
  while (!key.empty()) {
    const auto found = c.positions.find(key);
    if (found != c.positions.end())
      return found->second + (found->second == "--set" ? " " : ": ") + full;
    const auto dot = key.rfind('.');
    key.erase(dot == std::string::npos ? 0 : dot);
  }
  return c.file + ":1:1: " + full;
}

Case read_case(const std::string& path, const std::vector<std::string>& overrides) {
  const std::string text = read_text(path);
  Source source{path, parse(text, path), {}};
  for (const std::string& o : overrides) apply_override(source, o);

  Case c;
  const Table top(source, &source.root, "", "");
  c.title = top.word("title");
  if (c.title.size() > 200 || c.title.find('\n') != std::string::npos)
    top.fail("title", "is too long or of several lines; accepted: one line of at most 200 "
                      "characters");
  c.seed = static_cast<std::uint64_t>(top.number("seed"));
  const Table channel = section(source, "channel");
  read_channel(c, channel);
  const Table fluid = section(source, "fluid");
  fluid.require("viscosity");
  c.fluid.viscosity = fluid.quantity("viscosity");
  c.fluid.density = fluid.quantity("density");
  const Table numerics = section(source, "numerics");
  numerics.require("dx");
  c.numerics.dx = numerics.quantity("dx");
  check_size(c, channel);
  read_numerics(c, numerics);
  read_vessel(c, channel, path);
  const auto cells = entries(source, source.root.get("cell"), "cell", "cell");
  for (const Table& t : cells) c.cells.push_back(read_cell(t, path));
  check_placements(c, cells);
  for (const Table& t : entries(source, source.root.get("carrier"), "carrier", "carrier")) {
    c.carriers.push_back(read_carrier(t, c.fluid.density));
    if (c.carriers.back().feedback != c.carriers.front().feedback)
      t.fail("feedback", "differs from another [[carrier]]; accepted: the same for all");
  }
  const bool no_cells = drop_if_none(c.cells, source, "cell");
  const bool no_carriers = drop_if_none(c.carriers, source, "carrier");
  read_contact(c, section(source, "contact"));
  read_magnetic(c, source);
  const Table analysis = section(source, "analysis");
  read_analysis(c, analysis);
  read_run(c, section(source, "run"), analysis);
  read_output(c, section(source, "output"));
  c.file = path;
  note_positions(c, source, source.root, "");
  c.text = effective_text(source, c, no_cells || no_carriers ? "" : text);
  return c;
}

}  // namespace hemomag::case_
