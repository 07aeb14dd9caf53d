#include "case/keys.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace hemomag::case_ {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Key text(const char* t, const char* n, const char* fallback, const char* help) {
  return {t, n, Kind::text, nullptr, 0, 0, false, fallback, {}, {}, help};
}
Key integer(const char* t, const char* n, double min, double max, const char* fallback,
            const char* help) {
  return {t, n, Kind::integer, nullptr, min, max, false, fallback, {}, {}, help};
}
Key number(const char* t, const char* n, double min, double max, bool above, const char* fallback,
           const char* help) {
  return {t, n, Kind::number, nullptr, min, max, above, fallback, {}, {}, help};
}
Key flag(const char* t, const char* n, const char* fallback, const char* help) {
  return {t, n, Kind::flag, nullptr, 0, 0, false, fallback, {}, {}, help};
}
Key choice(const char* t, const char* n, std::vector<const char*> words,
           std::vector<const char*> later, const char* fallback, const char* help) {
  return {t,     n,        Kind::choice,     nullptr,          0,   0,
          false, fallback, std::move(words), std::move(later), help};
}
Key amount(const char* t, const char* n, const Dimension& d, double min, double max, bool above,
           const char* fallback, const char* help) {
  return {t, n, Kind::quantity, &d, min, max, above, fallback, {}, {}, help};
}
Key vector(const char* t, const char* n, const Dimension& d, double min, bool above,
           const char* fallback, const char* help) {
  return {t, n, Kind::vector, &d, min, inf, above, fallback, {}, {}, help};
}
Key direction(const char* t, const char* n, const char* fallback, const char* help) {
  return {t, n, Kind::direction, nullptr, 0, 0, false, fallback, {}, {}, help};
}
Key tables(const char* t, const char* n, const char* help) {
  return {t, n, Kind::tables, nullptr, 0, 0, false, "", {}, {}, help};
}

const std::vector<Key>& table() {
  using namespace dimension;
  static const std::vector<Key> all = {
      text("", "title", "hemomag case", "one line that names the study"),
      integer("", "seed", 0, 9.007e15, "1", "of every random draw"),
      vector("channel", "size", length, 0, true, "required",
             "x, y (flow) and z; whole multiples of dx"),
      choice("channel", "boundary", {"plates", "periodic", "tube", "voxels"}, {}, "plates",
             "plates close z; x and y are periodic; tube and voxels: see Vessels"),
      choice("channel", "plates", {"lower-rest", "symmetric"}, {}, "lower-rest",
             "the upper plate moves, or both, opposite ways"),
      amount("channel", "shear_rate", rate, 0, inf, false, "",
             "of the plates, along +y; without it and mean_velocity numerics.dt is required"),
      amount("channel", "body_force", force_density, -inf, inf, false, "",
             "drives the fluid along +y, or along channel.axis"),
      amount("channel", "mean_velocity", velocity, 0, inf, true, "",
             "of the fluid along +y or channel.axis, held by an adjusted body force; excludes "
             "body_force and shear_rate, needs walls"),
      choice("channel", "axis", {"x", "y", "z"}, {}, "y",
             "of the flow in a tube or voxels, and of the tube"),
      amount("channel", "diameter", length, 0, inf, true, "", "of the tube; required then"),
      text(
          "channel", "geometry", "",
          "surface file of the voxels (STL, OFF or PLY), relative to the case file; required then"),
      amount("channel", "geometry_unit", length, 0, inf, true, "1 um",
             "what one unit of that file is"),
      amount("fluid", "viscosity", viscosity, 0, inf, true, "required",
             "of plasma, inside cells too"),
      amount("fluid", "density", density, 0, inf, true, "1000 kg/m3", "the real one"),
      amount("numerics", "dx", length, 0, inf, true, "required", "node spacing"),
      number("numerics", "tau", 0.05, 100, false, "1.0",
             "relaxation time; the viscosity in lattice units is (tau - 1/2)/3, above 0.5, or "
             "tau/3 with the exponential scheme"),
      {"numerics",
       "cell_reynolds",
       Kind::number,
       nullptr,
       0,
       inf,
       true,
       "0.5",
       {"true"},
       {},
       "inertia scaling, rho shear_rate R^2/mu with R = 3.91 um, the shear rate that of the plates "
       "or mean_velocity over the width; \"true\" keeps the real density; excludes dt"},
      amount("numerics", "dt", time, 0, inf, true, "", "time step; excludes cell_reynolds"),
      choice("numerics", "scheme", {"trt", "bgk", "exponential"}, {}, "trt", "collision"),
      choice("numerics", "precision", {"double", "single"}, {}, "double", "of the populations"),
      choice("numerics", "kernel", {"cosine4", "peskin4", "roma3", "linear2"}, {}, "cosine4",
             "smoothed delta function of the coupling"),
      choice("cell", "kind", {"rbc", "platelet", "white"}, {}, "rbc",
             "red cell, platelet (oblate spheroid) or white cell (sphere): see Cells"),
      amount("cell", "diameter", length, 0, inf, true, "",
             "of a platelet (default 2.5 um) or a white cell (10 um); a red cell has 7.82 um"),
      amount("cell", "thickness", length, 0, inf, true, "1 um",
             "of a platelet, from 0.2 to 1 of its diameter"),
      integer("cell", "vertices", 162, 100000, "3286", "of the mesh; of a platelet 300 by default"),
      text(
          "cell", "mesh", "",
          "file of a closed surface (OFF, STL or PLY), relative to the case file, that is the rest "
          "shape as it is; excludes vertices, diameter and thickness"),
      amount("cell", "mesh_unit", length, 0, inf, true, "1 um", "what one unit of that file is"),
      number("cell", "hematocrit", 0, 0.6, true, "0.30",
             "volume fraction; the nearest whole number of cells; no default for other than red "
             "cells"),
      integer("cell", "count", 0, 1e7, "", "number of cells, instead of hematocrit"),
      choice("cell", "placement", {"random", "grid", "compress", "grow"}, {}, "random",
             "initial positions, or { file = \"packed.data\" }: see Dense blood"),
      choice("cell", "stress_free", {"biconcave", "sphere"}, {}, "biconcave",
             "shape in which a red cell's springs are at rest: its own, or a near-sphere of the "
             "same area; see Cells"),
      choice("cell", "hinges", {"rest", "flat"}, {}, "rest",
             "rest angles of the rest shape, or zero"),
      amount("cell", "shear_modulus", tension, 0, inf, true, "6.3 uN/m",
             "mu0 (Table 1); 63 uN/m for platelets and white cells"),
      amount("cell", "area_modulus_local", tension, 0, inf, false, "231 uN/m", "k_d"),
      amount("cell", "area_modulus_global", tension, 0, inf, false, "4.72 uN/m", "k_a"),
      amount("cell", "volume_modulus", pressure, 0, inf, false, "249 N/m2", "k_v"),
      amount("cell", "bending_modulus", energy, 0, inf, false, "5e-19 J",
             "k_b of Eq. 20; 5e-18 J for platelets and white cells"),
      number("cell", "stretch_ratio", 0.1, 0.95, false, "0.45454545454545453",
             "l0/l_max of the springs"),
      choice("carrier", "kind", {"particle", "worm"}, {}, "particle",
             "sphere, or bonded chain of spheres"),
      integer("carrier", "count", 0, 1e8, "80", "how many"),
      integer("carrier", "beads", 2, 10000, "32", "of a worm"),
      amount("carrier", "stretching", tension, 0, inf, true, "630 uN/m",
             "k of U = k (l - l0)^2 between beads of a worm"),
      amount("carrier", "bending", energy, 0, inf, false, "4.14e-20 J",
             "kappa of U = kappa (theta - theta0)^2 along a worm"),
      amount("carrier", "radius", length, 0, inf, true, "125 nm", "of a particle or bead"),
      number("carrier", "susceptibility", -1, inf, true, "0.4",
             "chi, volume susceptibility relative to plasma"),
      number("carrier", "magnetic_fraction", 0, 1, false, "0.6",
             "part of the volume that is magnetic"),
      amount(
          "carrier", "saturation_magnetisation", magnetisation, 0, inf, true, "",
          "of the magnetic part, where Langevin's law ends; without it the moment is linear in B"),
      amount("carrier", "density", density, 0, inf, true, "",
             "gives it inertia, see Carriers; without it carriers have none"),
      flag("carrier", "feedback", "true", "false: one-way, the fluid does not feel the carrier"),
      number("contact", "morse_depth", 0, inf, false, "0.04",
             "kBT per vertex pair at 3286 vertices, times (3286/vertices)^2; 0 turns it off"),
      amount("contact", "morse_beta", per_length, 0, inf, true, "3.84 um-1",
             "inverse width of the Morse well"),
      amount("contact", "morse_r0", length, 0, inf, true, "0.5 um", "distance of its minimum"),
      amount("contact", "morse_cutoff", length, 0, inf, true, "1.5 um", "its range"),
      amount("contact", "cell_sigma", length, 0, inf, true, "",
             "cell-cell repulsion; default 0.6 x longest rest edge, at least 0.25 um"),
      amount("contact", "carrier_sigma", length, 0, inf, true, "0.5 um", "cell-carrier repulsion"),
      choice("contact", "carrier_contact", {"vertices", "surface"}, {}, "vertices",
             "carriers from cells: Lennard-Jones from vertices (carrier_sigma), or from the "
             "triangles between them (surface_range, surface_stiffness)"),
      amount("contact", "surface_range", length, 0, inf, true, "0.25 um",
             "centre of a carrier from a cell's surface, where the repulsion begins"),
      amount("contact", "surface_stiffness", tension, 0, inf, true, "50 uN/m",
             "of that repulsion where it begins"),
      number("contact", "epsilon", 0, inf, true, "1.0",
             "kBT at 3286 vertices, times (3286/vertices)^2 cell-cell, times 3286/vertices "
             "cell-carrier"),
      amount("contact", "plate_sigma", length, 0, inf, true, "0.25 um",
             "vertices and carriers from plates or the vessel's wall, 1 kBT"),
      choice("contact", "repulsion", {"soft", "paper"}, {}, "soft",
             "carrier-carrier: exponential, or Eq. 26"),
      number("contact", "repulsion_kappa", 4, inf, true, "30",
             "steepness of the exponential: it falls to 1/e over 1/kappa of the contact distance"),
      choice("magnetic", "field",
             {"none", "uniform", "gradient", "quadrupole", "rotating", "magnet", "coil", "wire",
              "table"},
             {}, "gradient",
             "external field (none without a [magnetic] table): see Magnetic fields"),
      tables("magnetic", "source", "fields that add up, each with the keys of [magnetic]"),
      amount("magnetic", "B0", field, 0, inf, false, "0.05 T",
             "strength of a uniform, gradient or rotating field"),
      direction("magnetic", "axis", "z",
                "of a uniform field, a gradient (a word then), a magnet (third edge of a block), a "
                "coil (its turns) or a wire (its current)"),
      amount("magnetic", "gradient", field_gradient, -inf, inf, false, "",
             "dB/dx along the axis, instead of B0 (1 - z/H); required for a quadrupole"),
      vector("magnetic", "zero_at", length, -inf, false, "0 um, 0 um, 0 um",
             "where an explicit gradient's or a quadrupole's field vanishes"),
      choice("magnetic", "plane", {"xy", "yz", "zx", "yx", "zy", "xz"}, {}, "yz",
             "of a quadrupole, B = gradient (along the first axis, against the second), and of a "
             "rotating field, which turns from the first axis to the second"),
      vector("magnetic", "position", length, -inf, false, "",
             "centre of a magnet or coil, a point of a wire; required then; of a table, where its "
             "own origin lies (0 by default)"),
      choice("magnetic", "shape", {"block", "cylinder"}, {}, "block", "of a magnet"),
      vector("magnetic", "size", length, 0, true, "",
             "three edges of a block, the third along axis; required then"),
      direction("magnetic", "across", "",
                "of a block's first edge, made perpendicular to axis; by default the coordinate "
                "axis that is farthest from axis"),
      amount("magnetic", "diameter", length, 0, inf, true, "",
             "of a cylinder or coil; required then"),
      amount("magnetic", "length", length, 0, inf, true, "", "of a cylinder; required then"),
      amount("magnetic", "remanence", field, 0, inf, true, "",
             "of a magnet, mu* times its magnetisation; required then"),
      direction("magnetic", "magnetisation", "",
                "of a block, axis by default; a cylinder is magnetised along its axis"),
      amount("magnetic", "current", current, -inf, inf, false, "",
             "of a coil or wire; required then"),
      integer("magnetic", "turns", 1, 1e6, "1", "of a coil, all in one place"),
      choice("magnetic", "pair", {"none", "same", "opposite"}, {}, "none",
             "of coils about position: a second coil with the same or the opposite current"),
      amount("magnetic", "distance", length, 0, inf, true, "",
             "between the coils of a pair; required then"),
      text("magnetic", "file", "",
           "table of B on a grid, relative to the case file (docs/field_table.md); required then"),
      amount("magnetic", "frequency", frequency, 0, inf, true, "",
             "of a rotating field or time = \"sine\"; required then"),
      choice(
          "magnetic", "time", {"constant", "sine", "ramp", "pulse"}, {}, "constant",
          "factor of the field: 1; sin(2 pi frequency t); from 0 at start to 1 after duration; 1 "
          "from start on for duration, else 0"),
      amount("magnetic", "start", time, 0, inf, false, "0 s", "of a ramp or pulse"),
      amount("magnetic", "duration", time, 0, inf, true, "", "of a ramp or pulse; required then"),
      flag("magnetic", "dipoles", "true", "carrier-carrier interaction"),
      {"analysis",
       "layer",
       Kind::quantity,
       &length,
       0,
       inf,
       true,
       "2.8 um",
       {"measured"},
       {},
       "thickness of the cell-free layer, or from a run of the cells alone: see Cell-free layer"},
      amount("analysis", "layer_run", time, 0, inf, true, "0.2 s",
             "simulated time of that run, whose second half counts"),
      choice("analysis", "walls", {"lower", "both", "vessel"}, {}, "lower",
             "which layers count; in a tube or voxels it is vessel, the layer along the wall"),
      amount("analysis", "average_from", time, 0, inf, false, "0.5 s",
             "start of the time average of Eq. 46; the default is 0 s in a run that is shorter"),
      amount("run", "time", time, 0, inf, true, "", "simulated time; or give steps"),
      integer("run", "steps", 1, 9.007e15, "",
              "number of steps, of which 2147483647 can be run; or give time"),
      {"run",
       "checkpoint",
       Kind::quantity,
       &time,
       0,
       inf,
       false,
       "10 min",
       {"never"},
       {},
       "wall time between checkpoints, or \"never\": at the end and by signals only"},
      {"output",
       "fields",
       Kind::quantity,
       &time,
       0,
       inf,
       true,
       "0.05 s",
       {"never"},
       {},
       "simulated time between 3-D snapshots"},
      {"output",
       "series",
       Kind::quantity,
       &time,
       0,
       inf,
       true,
       "0.001 s",
       {"never"},
       {},
       "simulated time between rows of margination.csv"},
      {"output",
       "cells",
       Kind::quantity,
       &time,
       0,
       inf,
       true,
       "",
       {"never"},
       {},
       "simulated time between rows of cells.csv; the default is that of fields"},
      {"output",
       "profiles",
       Kind::quantity,
       &time,
       0,
       inf,
       true,
       "",
       {"never"},
       {},
       "simulated time between samples of profiles.csv and rows of layer.csv; 0.005 s by default "
       "between plates"},
  };
  return all;
}

std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row[b.size()];
}

std::string listed(const std::vector<const char*>& words) {
  std::string text;
  for (const char* word : words) text += (text.empty() ? "\"" : ", \"") + std::string(word) + "\"";
  return text;
}

std::string range(const Key& key) {
  char text[96] = "";
  const bool low = key.min > -inf, high = key.max < inf;
  if (low && high)
    std::snprintf(text, sizeof text, "%s %g and at most %g", key.above_min ? "above" : "at least",
                  key.min, key.max);
  else if (low)
    std::snprintf(text, sizeof text, "%s %g", key.above_min ? "above" : "at least", key.min);
  return text;
}

}  // namespace

std::span<const Key> keys() { return table(); }

const Key* find_key(const std::string& t, const std::string& name) {
  for (const Key& key : table())
    if (t == key.table && name == key.name) return &key;
  return nullptr;
}

std::string nearest_name(const std::string& t, const std::string& name) {
  std::string best;
  std::size_t least = 4;
  const auto consider = [&](const std::string& candidate) {
    const std::size_t d = distance(name, candidate);
    if (d < least) least = d, best = candidate;
  };
  for (const Key& key : table()) {
    if (t == key.table) consider(key.name);
    if (t.empty()) consider(key.table);
  }
  return best;
}

std::string accepted(const Key& key) {
  std::string words;
  switch (key.kind) {
  case Kind::text:
    return "a string";
  case Kind::direction:
    return "\"x\", \"y\", \"z\" or three numbers, e.g. [0, 1, -1]";
  case Kind::tables:
    return std::string("[[") + key.table + "." + key.name + "]] entries";
  case Kind::flag:
    return "true or false";
  case Kind::choice:
    return listed(key.choices);
  case Kind::integer:
    words = "a whole number";
    break;
  case Kind::number:
    words = "a number";
    break;
  case Kind::quantity:
    words = std::string(key.dimension->noun) + ", e.g. \"" + key.dimension->example + "\"";
    break;
  case Kind::vector:
    words = std::string("three of ") + key.dimension->noun + ", e.g. [\"" + key.dimension->example +
            "\", ...]";
    break;
  }
  const std::string limits = range(key);
  if (!limits.empty())
    words += ", " + limits + (key.dimension ? std::string(" ") + key.dimension->unit : "");
  if (!key.choices.empty()) words += ", or " + listed(key.choices);
  return words;
}

}  // namespace hemomag::case_
