#include "case/card.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numbers>
#include <optional>

#include "case/external_field.hpp"
#include "case/lattice_units.hpp"
#include "case/packing.hpp"
#include "case/script.hpp"
#include "lammps/fix_hemo_drag.h"
#include "magnetic/clearance.hpp"
#include "magnetic/dipole.hpp"
#include "magnetic/moment.hpp"

namespace hemomag::case_ {
namespace {

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  char buffer[256];
  va_list args;
  va_start(args, format);
  std::vsnprintf(buffer, sizeof buffer, format, args);
  va_end(args);
  return buffer;
}

/// Share of the largest gradient from which div B or curl B is noted: a smooth table has less.
constexpr double noted_violation = 0.01;

/// Small is fine, then doubtful, then refused.
Verdict below(double value, double fine, double refused) {
  return value <= fine ? Verdict::fine : value <= refused ? Verdict::doubtful : Verdict::refused;
}

class CardWriter {
public:
  CardWriter(const Case& c, const std::vector<CellModel>& models)
      : c_(c), models_(models), units_(lattice_units(c)) {}

  Card write() {
    key_ = "numerics";
    scales();
    key_ = "channel";
    vessel();
    flow();
    for (std::size_t m = 0; m < c_.cells.size(); ++m) {
      key_ = entry_path("cell", m, c_.cells.size());
      cells(m);
    }
    if (sources_clear()) field();
    for (std::size_t k = 0; k < c_.carriers.size(); ++k) {
      key_ = entry_path("carrier", k, c_.carriers.size());
      carriers(c_.carriers[k]);
    }
    cost();
    return card_;
  }

private:
  void add(const char* name, std::string value, Verdict verdict = Verdict::fine,
           std::string advice = {}) {
    card_.lines.push_back({name, std::move(value), verdict,
                           verdict == Verdict::fine ? std::string() : std::move(advice),
                           position(c_, key_)});
  }

  void scales() {
    const auto n = nodes(c_);
    add("grid", text("%d x %d x %d nodes, dx = %.4g um", n[0], n[1], n[2], units_.dx * 1e6));
    add("time step", text("dt = %.4g us, %ld steps, %.4g s", units_.dt * 1e6, steps(c_),
                          static_cast<double>(steps(c_)) * units_.dt));
    tau();
    const double factor = units_.density / c_.fluid.density;
    add("inertia scaling", text("density x %.4g", factor),
        factor > 500 ? Verdict::doubtful : Verdict::fine, "lower numerics.cell_reynolds or dt");
  }

  void tau() {
    const double tau = c_.numerics.tau;
    const bool exponential = c_.numerics.scheme == "exponential";
    const double low = exponential ? 0.2 : 0.6, high = exponential ? 1.2 : 1.5;
    add("tau", text("%.4g", tau), tau >= low && tau <= high ? Verdict::fine : Verdict::doubtful,
        tau > high    ? text("unsteady flow loses accuracy above %g; lower tau", high)
        : exponential ? "unsteady flow loses accuracy below 0.2; raise tau"
                      : "close to the limit of stability 0.5; raise tau");
  }

  void vessel() {
    if (c_.channel.boundary == Boundary::tube)
      add("vessel",
          text("tube of %.4g um along %c", c_.channel.diameter * 1e6, "xyz"[c_.channel.axis]));
    if (c_.channel.boundary == Boundary::voxels) voxels();
    if (c_.channel.mean_velocity)
      add("mean velocity",
          text("%.4g mm/s along %c, force from %.4g N/m3", *c_.channel.mean_velocity * 1e3,
               "xyz"[c_.channel.axis], starting_force(c_)));
  }

  void voxels() {
    const VesselOnGrid& v = c_.vessel;
    add("vessel", text("%ld nodes in the fluid, about %.3g um at its widest", v.fluid_nodes,
                       2 * v.widest * units_.dx * 1e6));
    const long unmatched = v.unmatched[0] + v.unmatched[1] + v.unmatched[2];
    const auto axis = static_cast<std::size_t>(c_.channel.axis);
    const bool driven = c_.channel.mean_velocity || c_.channel.body_force[axis] != 0;
    const bool closed = driven && v.open[axis] == 0;
    add("open ends",
        text("x %ld, y %ld, z %ld nodes, %ld unmatched", v.open[0], v.open[1], v.open[2],
             unmatched),
        closed          ? Verdict::refused
        : unmatched > 0 ? Verdict::doubtful
                        : Verdict::fine,
        closed ? text("fluid nodes at both ends of the box along %c, or no driving force along it",
                      "xyz"[c_.channel.axis])
               : text("%ld fluid nodes at a face meet solid on the opposite one; end the vessel "
                      "alike on both",
                      unmatched));
  }

  void flow() {
    const double W = width(c_), mu = c_.fluid.viscosity, speed = fastest_flow(c_);
    const double mach = speed / units_.velocity() * std::sqrt(3.0);
    add("wall Mach number", text("%.3g (fastest flow %.4g mm/s)", mach, speed * 1e3),
        below(mach, 0.15, 0.3),
        c_.channel.shear_rate > 0
            ? "under 0.3; lower cell_reynolds or tau, or use plates = \"symmetric\""
            : "under 0.3; lower the flow, tau, or numerics.dt or cell_reynolds");
    const double rate = nominal_shear_rate(c_);
    if (rate <= 0) return;
    const double re_cell = units_.density * rate * cell_radius * cell_radius / mu;
    const double re_channel = units_.density * rate * W * W / mu;
    add("Reynolds number, cell", text("%.3g", re_cell), below(re_cell, 0.5000001, 2),
        "lower numerics.cell_reynolds");
    add("Reynolds number, channel", text("%.3g", re_channel), below(re_channel, 20, 100),
        "lower numerics.cell_reynolds");
  }

  void cells(std::size_t m) {
    const Cell& cell = c_.cells[m];
    const CellModel& model = models_[m];
    const int count = cell_count(c_, cell, model);
    const char* kind = cell.kind == CellKind::platelet ? " platelets"
                       : cell.kind == CellKind::white  ? " white cells"
                                                       : "";
    const double hematocrit = count * model.volume / fluid_volume(c_);
    const bool rounded_away = count == 0 && !cell.count;
    const double one = model.volume / fluid_volume(c_);  // to which a hematocrit is rounded
    const bool too_dense = hematocrit > largest_hematocrit + one / 2 && fits_into_box(model);
    add("cells",
        text("%d%s of %d vertices, hematocrit %.4g", count, kind, cell.vertices, hematocrit),
        rounded_away || too_dense ? Verdict::refused : Verdict::fine,
        rounded_away ? text("a hematocrit from %.3g, which is one cell, or count = 0", one)
                     : text("a hematocrit up to %g", largest_hematocrit));
    size_of_cell(model);
    if (cell.surface) mesh_quality(model);
    if (cell.stress_free == StressFree::sphere) prestress(cell, model);
    const double eta = units_.pressure() * units_.dt;  // the unit of viscosity
    const double S = (cell.area_modulus_local + cell.area_modulus_global + 2 * cell.shear_modulus) /
                     units_.tension() / (2 * c_.fluid.viscosity / eta);
    add("membrane stability S", text("%.3g", S), below(S, 5, 15),
        "(k_d + k_a + 2 mu0)/(2 eta) in lattice units under 15; lower cell_reynolds or "
        "area_modulus_local");
    const double edge = model.longest_edge / units_.dx;
    add("longest mesh edge", text("%.3g dx", edge), below(edge, 1.5, 4),
        "more vertices or a larger dx keep the membrane tight");
    const double finest = std::sqrt(model.area / cell.vertices) / units_.dx;
    add("mesh spacing", text("%.3g dx", finest), finest >= 0.3 ? Verdict::fine : Verdict::doubtful,
        "fewer vertices or a smaller dx");
    if (nominal_shear_rate(c_) > 0)
      add("capillary number", text("Ca = %.3g", c_.fluid.viscosity * nominal_shear_rate(c_) *
                                                    model.radius / cell.shear_modulus));
  }

  double widest() const {
    return std::max({c_.channel.size[0], c_.channel.size[1], c_.channel.size[2]});
  }
  bool fits_into_box(const CellModel& model) const { return 2 * model.reach < widest(); }

  /// A unit that was mistaken shows here.
  void size_of_cell(const CellModel& model) {
    if (fits_into_box(model)) return;
    add("cell size", text("%.4g um", 2e6 * model.reach), Verdict::refused,
        text("less than the box, %.4g um; see cell.diameter or cell.mesh_unit", widest() * 1e6));
  }

  /// Of a user's surface; the generator's own meshes are within the gates.
  void mesh_quality(const CellModel& model) {
    using membrane::MeshGates;
    const auto q = membrane::quality(model.mesh);
    const bool even = q.mean_edge_ratio <= MeshGates::mean_edge_ratio &&
                      q.worst_edge_ratio <= MeshGates::worst_edge_ratio &&
                      q.smallest_angle >= MeshGates::smallest_angle;
    add("mesh quality",
        text("edge ratio %.3g, at worst %.3g, angles from %.3g", q.mean_edge_ratio,
             q.worst_edge_ratio, q.smallest_angle),
        even ? Verdict::fine : Verdict::doubtful,
        text("an isotropic membrane needs %g, %g and %g degrees; remesh the surface",
             MeshGates::mean_edge_ratio, MeshGates::worst_edge_ratio, MeshGates::smallest_angle));
  }

  void prestress(const Cell& cell, const CellModel& model) {
    const double drawn = model.prestress.longest * cell.stretch_ratio;
    add("prestress",
        text("|l/l0 - 1| %.3g, at most %.3g; l/l_max %.3g", model.prestress.mean,
             model.prestress.largest, drawn),
        below(drawn, 0.7, 0.9),
        "l/l_max under 0.9, where the springs have room to stretch; lower stretch_ratio");
  }

  void carriers(const Carrier& carrier) {
    const double R = point_radius(c_);
    const bool too_large = carrier.feedback && carrier.radius >= R;
    add("carriers",
        text("%d of radius %.4g nm%s", carrier.count, carrier.radius * 1e9,
             carrier.feedback ? "" : ", one-way"),
        too_large ? Verdict::refused : Verdict::fine,
        text("radius under the kernel's own, %.4g nm; use a larger dx", R * 1e9));
    if (too_large) return;
    if (carrier.density) inertia(carrier);
    pull(carrier);
    if (c_.magnetic.dipoles) contact(carrier);
    surface_contact(carrier);
    if (carrier.kind == CarrierKind::worm) worm(carrier);
  }

  void inertia(const Carrier& carrier) {
    const double relaxation = inertial_mass(c_, carrier) / bare_friction(c_, carrier);
    add("carrier inertia",
        text("m/Gamma = %.3g us, %.3g steps", relaxation * 1e6, relaxation / units_.dt));
  }

  /// Carriers go everywhere in the box: no matter of a source may be there, and no table end.
  bool sources_clear() {
    const auto n = nodes(c_);
    const Vec3 low, high{1.0 * n[0], 1.0 * n[1], 1.0 * n[2]};
    bool clear = true;
    for (const MagneticSource& s : c_.magnetic.sources) {
      key_ = s.key;
      const magnetic::Field alone = external_field(c_, s);
      for (const auto& source : alone.sources()) {
        const auto gap = magnetic::gap(source.shape, low, high);
        const bool touches = gap && gap->distance < magnetic::least_gap;
        if (gap)
          add("clear of the channel", text("%.4g um", gap->distance * units_.dx * 1e6),
              touches ? Verdict::refused : Verdict::fine,
              "a magnet, coil or wire outside the box of the channel; see position");
        const bool covers = magnetic::covers(source.shape, low, high);
        if (!covers)
          add("table", "ends inside the box", Verdict::refused,
              "a grid that covers the box of the channel; see position");
        clear = clear && !touches && covers;
      }
    }
    return clear;
  }

  /// What the fields are throughout the box and the run.
  void field() {
    key_ = "magnetic";
    if (c_.magnetic.sources.empty()) return;
    survey_.emplace(c_);
    double gradient = 0, div = 0, rot = 0;
    bool finite = true;
    survey_->for_each([&](const magnetic::FieldAt& at) {
      finite = finite && std::isfinite(norm(at.B) + magnetic::gradient_norm(at));
      strongest_ = std::max(strongest_, norm(at.B) * units_.magnetic_field());
      gradient = std::max(gradient, magnetic::gradient_norm(at));
      div = std::max(div, std::fabs(magnetic::divergence(at)));
      rot = std::max(rot, norm(magnetic::curl(at)));
    });
    const double T_m = units_.magnetic_field() / units_.dx;
    add("largest field", finite ? text("%.4g T", strongest_) : "not finite",
        finite ? Verdict::fine : Verdict::refused, "sources nearer, smaller or weaker than these");
    add("largest field gradient", text("%.4g T/m", gradient * T_m));
    const auto violated = [&](const char* name, double value) {
      if (value > noted_violation * gradient)
        add(name, text("%.3g T/m", value * T_m), Verdict::note,
            "is zero in nature: a model, not a field that a magnet can make");
    };
    violated("div B", div);
    violated("curl B", rot);
    for (const MagneticSource& s : c_.magnetic.sources)
      if (s.frequency > 0) frequency(s);
  }

  void frequency(const MagneticSource& s) {
    key_ = s.key;
    const double steps = 1 / (s.frequency * units_.dt);
    add("steps a turn", text("%.4g", steps),
        steps >= 20   ? Verdict::fine
        : steps >= 10 ? Verdict::doubtful
                      : Verdict::refused,
        "at least 10, better 20: a lower frequency or dt");
  }

  /// The field of the paper grows along one axis, and the distance from its zero with exp(t/T_e).
  void growth_time(const Carrier& carrier) {
    const auto& sources = c_.magnetic.sources;
    if (sources.size() != 1 || sources[0].field != FieldKind::gradient) return;
    const double slope = gradient_field(c_, sources[0]).slope;
    if (slope != 0)
      add("magnetic time T_e",
          text("%.4g ms", 1e3 * stokes_friction(c_, carrier) * vacuum_permeability /
                              (susceptible_volume(carrier) * slope * slope)));
  }

  /// Drift under the largest force that the fields exert anywhere in the box.
  void pull(const Carrier& carrier) {
    if (!survey_) return;
    const auto law = magnetisation(c_, carrier);
    double largest = 0;
    survey_->for_each([&](const magnetic::FieldAt& at) {
      largest = std::max(largest, norm(magnetic::gradient_force(law.moment(at.B), at)));
    });
    const double force = largest * units_.force();
    const double drift = force / stokes_friction(c_, carrier), per_step = drift / units_.velocity();
    add("largest pull", text("%.4g pN", force * 1e12));
    growth_time(carrier);
    add("drift", text("%.4g mm/s, %.3g dx a step", drift * 1e3, per_step),
        below(per_step, 0.05, 0.1),
        text("under 0.1 dx a step: at most %.3g times this field, or a smaller dt",
             std::sqrt(0.1 / per_step)));
    const double re = units_.density * drift * 2 * carrier.radius / c_.fluid.viscosity;
    add("Reynolds number, carrier", text("%.3g", re), below(re, 0.1, 0.5),
        "a weaker field or a lower cell_reynolds");
  }

  /// In the strongest field, over sqrt(mu*): the laws of the magnetic room, in which mu* is one,
  /// then give SI forces.
  double largest_moment(const Carrier& carrier) const {
    const double unit = units_.magnetic_field();
    const Vec3 m = magnetisation(c_, carrier).moment({0, 0, strongest_ / unit});
    return norm(m) * unit * std::pow(units_.dx, 3) / std::sqrt(vacuum_permeability);
  }

  /// Strength and stiffness of carrier-carrier contact in the strongest field.
  void contact(const Carrier& carrier) {
    const double d = 2 * carrier.radius;
    const double m = largest_moment(carrier);
    const double lambda = m * m / (4 * std::numbers::pi * d * d * d * kBT);
    add("dipole strength lambda", text("%.3g (contact energy over 2 kBT)", lambda));
    const double cutoff = dipole_cutoff(c_) * units_.dx;
    add("dipole cut-off", text("%.4g um, neglects %.2g of the contact pull", cutoff * 1e6,
                               magnetic::neglected_pull(d, cutoff)));
    const double substeps = magnetic::contact_substeps(contact_stiffness(carrier) * units_.dt /
                                                       bare_friction(c_, carrier));
    add("contact sub-steps", text("%.0f", substeps),
        substeps <= LAMMPS_NS::FixHemoDrag::most_substeps ? Verdict::fine : Verdict::refused,
        text("at most %d: lower B0 or dt", LAMMPS_NS::FixHemoDrag::most_substeps));
  }

  /// Seven triangles at a vertex push a carrier that takes explicit steps: stable below 2.
  void surface_contact(const Carrier& carrier) {
    if (c_.contact.carrier_contact != CarrierContact::surface || c_.cells.empty()) return;
    constexpr double triangles = 7, stable = 2;
    const double friction = bare_friction(c_, carrier);
    const double ratio = triangles * c_.contact.surface_stiffness * units_.dt / friction;
    add("surface contact", text("7 k dt/Gamma = %.3g", ratio), below(ratio, stable / 4, stable),
        text("under %g: the largest stable contact.surface_stiffness is %.3g uN/m here", stable,
             1e6 * stable * friction / (triangles * units_.dt)));
  }

  /// Contact stiffness in the strongest field [N/m].
  double contact_stiffness(const Carrier& carrier) const {
    if (!c_.magnetic.dipoles) return 0;
    const double d = 2 * carrier.radius;
    const double m = largest_moment(carrier);
    const double pull = magnetic::contact_pull(m, m, d);
    return c_.contact.repulsion == Repulsion::soft
               ? magnetic::soft_stiffness(pull, c_.contact.repulsion_kappa, d)
               : magnetic::paper_stiffness(pull, 0.1 * kBT, 0.1 * carrier.radius);
  }

  /// Largest stable 8 k dt/Gamma of the bonds of a chain whose contacts add the rate c = 4
  /// k_contact dt/Gamma in their own n = ceil(c/2) sub-steps while the bonds stand still: the
  /// stiffest mode is multiplied by q - (b/c)(1 - q), q = (1 - c/n)^n, in a step, which has to
  /// stay above -1. Without contact forces the limit is 2.
  static double bond_limit(double c) {
    if (c < 1e-9) return 2;
    const double n = magnetic::contact_substeps(c / 4);
    const double q = std::pow(1 - c / n, n);
    return c * (1 + q) / (1 - q);
  }

  void worm(const Carrier& carrier) {
    const double friction = bare_friction(c_, carrier);
    const double ratio = 8 * carrier.stretching * units_.dt / friction;
    const double limit = bond_limit(4 * contact_stiffness(carrier) * units_.dt / friction);
    add("worm bond stability", text("8 k dt/Gamma = %.3g", ratio),
        ratio < limit ? Verdict::fine : Verdict::refused,
        text("under %.3g: the largest stable stretching is %.3g uN/m here", limit,
             limit * friction / (8 * units_.dt) * 1e6));
    const double length = 2 * carrier.radius * carrier.beads;
    const double box = std::min({c_.channel.size[0], c_.channel.size[1], c_.channel.size[2]});
    add("worm length", text("%.4g um", length * 1e6),
        length < box ? Verdict::fine : Verdict::refused, "shorter than the channel");
    // The bending mode of a discrete chain is stiffest at 16 kappa 2/l0^2 for U = kappa (theta -
    // theta0)^2.
    const double bending =
        32 * carrier.bending / (4 * carrier.radius * carrier.radius) * units_.dt / friction;
    add("worm bending stability", text("32 kappa dt/(l0^2 Gamma) = %.3g", bending),
        below(bending, 1, 2), "under 2: lower carrier.bending or dt");
  }

  struct NodeCost {
    double bytes, seconds;
  };

  /// Of a node; measured for trt in double precision. The others follow from what they move:
  /// single precision halves the 19 populations of 25 numbers, the exponential scheme keeps a
  /// second set and moves about twice as much. Solid nodes count like fluid.
  NodeCost node_cost() const {
    NodeCost node{210, 10e-9};
    const double populations = c_.numerics.precision == "single" ? 0.5 : 1;
    node.bytes -= (1 - populations) * 19 * 8;
    node.seconds *= 1 - (1 - populations) * 19 / 25;
    if (c_.numerics.scheme == "exponential") node.bytes += populations * 19 * 8, node.seconds *= 2;
    return node;
  }

  void cost() {
    const auto n = nodes(c_);
    const double grid = static_cast<double>(n[0]) * n[1] * n[2];
    double vertices = 0;
    for (std::size_t m = 0; m < c_.cells.size(); ++m)
      vertices +=
          static_cast<double>(cell_count(c_, c_.cells[m], models_[m])) * c_.cells[m].vertices;
    // Measured with one and two ranks on the demo and on 108 x 144 x 96 nodes with 40 cells of
    // 3286 vertices: 210 bytes a node, 2.5 kB a vertex with its lists, 50 MB a rank. On two cores
    // these take 2.2 and 60 ms a step, which 10 ns a node and 250 ns a vertex meet to a quarter.
    const NodeCost node = node_cost();
    const double seconds =
        static_cast<double>(steps(c_)) * (grid * node.seconds + vertices * 250e-9);
    add("memory",
        text("about %.0f MB and 50 MB a rank", (grid * node.bytes + vertices * 2.5e3) / 1e6));
    add("time", seconds < 120    ? text("about %.0f s on 2 cores", seconds)
                : seconds < 7200 ? text("about %.0f minutes on 2 cores", seconds / 60)
                                 : text("about %.0f hours on 2 cores", seconds / 3600));
  }

  const Case& c_;
  const std::vector<CellModel>& models_;
  LatticeUnits units_;
  std::optional<FieldSurvey> survey_;  // of fields whose sources are clear of the box
  double strongest_ = 0;               // largest |B| [T]
  std::string key_;                    // of the part of the case a line is about
  Card card_;
};

const char* word(Verdict verdict) {
  switch (verdict) {
  case Verdict::fine:
    return "fine";
  case Verdict::note:
    return "note";
  case Verdict::doubtful:
    return "doubtful";
  default:
    return "refused";
  }
}

std::string print_line(const CardLine& l) {
  std::string line = text("%-26s %-44s %s", l.name.c_str(), l.value.c_str(), word(l.verdict));
  if (!l.advice.empty()) line += ": " + l.advice;
  return line + "\n";
}

}  // namespace

bool Card::refused() const {
  return std::any_of(lines.begin(), lines.end(),
                     [](const CardLine& l) { return l.verdict == Verdict::refused; });
}

std::string Card::print() const {
  std::string all;
  for (const CardLine& l : lines) all += print_line(l);
  return all;
}

std::string Card::refusals() const {
  std::string all;
  for (const CardLine& l : lines)
    if (l.verdict == Verdict::refused)
      all += l.position + ": " + l.name + ", " + l.value + ", is refused; accepted: " + l.advice +
             "\n";
  return all;
}

Card make_card(const Case& c, const std::vector<CellModel>& models) {
  return CardWriter(c, models).write();
}

}  // namespace hemomag::case_
