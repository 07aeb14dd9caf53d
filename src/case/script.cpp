#include "case/script.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <optional>

#include "case/cells_data.hpp"
#include "case/external_field.hpp"
#include "case/lattice_units.hpp"
#include "contact/lennard_jones.hpp"

namespace hemomag::case_ {
namespace {

constexpr double dipole_radii =
    12;  // cut-off of the dipole forces: 0.08 % of the contact pull beyond it
constexpr int watch_every = 100;
constexpr int inside_looks = 10;  // on end: a carrier that only grazed a membrane is out by then

const char* layer_walls(LayerWalls walls) {
  return walls == LayerWalls::lower ? "lower" : walls == LayerWalls::both ? "both" : "vessel";
}

class Script {
public:
  Script(const Case& c, const System& system)
      : c_(c), system_(system), units_(lattice_units(c)), cells_(c.cells.size()),
        carriers_(c.carriers.size()) {
    for (const Carrier& carrier : c.carriers) worms_ = worms_ || carrier.kind == CarrierKind::worm;
  }

  /// The run writes checkpoints, and may go on from one.
  struct Saving {
    std::string resume;  ///< directory of the checkpoint it goes on from, or empty
    double wall_s = 0;   ///< that the run has taken until then
  };

  std::string write(const std::optional<Saving>& saving) {
    const std::string resume = saving ? saving->resume : "";
    const char* z = c_.channel.boundary == Boundary::plates ? "f" : "p";
    std::string title = c_.title;  // LAMMPS reads on after these two
    std::replace(title.begin(), title.end(), '"', '\'');
    std::replace(title.begin(), title.end(), '&', '+');
    line("# %s", title.c_str());
    line("# lattice units: dx = %.9g m, dt = %.9g s, density = %.9g kg/m3", units_.dx, units_.dt,
         units_.density);
    line("units lj\natom_style molecular\nnewton on\nboundary p p %s\nspecial_bonds lj/coul 1 1 1",
         z);
    line("neighbor %g bin\ncomm_modify cutoff %.9g", skin, ghost_cutoff());
    bonded_styles();
    if (resume.empty()) {
      line("read_data cells.data");
    } else {
      line("read_restart %s/atoms.restart", resume.c_str());
      // LAMMPS keeps the coefficients of a style, but not those of a hybrid of several.
      if (cells_ > 0 && worms_) t_ += coefficient_commands(c_, system_);
    }
    groups();
    line("mass * 1.0");
    pairs();
    fixes();
    observers();
    if (saving) checkpoints(*saving);
    line("timestep 1.0\nthermo_style custom step atoms ebond eangle edihed epair f_fluid\nthermo "
         "%ld",
         std::max(1L, steps(c_) / 100));
    line(resume.empty() ? "run %ld" : "run %ld upto", steps(c_));
    return t_;
  }

private:
  double length(double metres) const { return metres / units_.dx; }

  /// The largest distance between atoms that share a hinge or a pair, and the skin.
  double ghost_cutoff() const {
    double reach = 0;
    for (std::size_t m = 0; m < cells_; ++m)
      reach = std::max(reach,
                       length(system_.models[m].longest_rest_length / c_.cells[m].stretch_ratio));
    for (const Carrier& carrier : c_.carriers)
      if (carrier.kind == CarrierKind::worm) reach = std::max(reach, length(6 * carrier.radius));
    if (surface_contact()) reach += length(c_.contact.surface_range);
    return std::max(reach, largest_pair_cutoff()) + skin;
  }

  bool surface_contact() const {
    return cells_ > 0 && carriers_ > 0 && c_.contact.carrier_contact == CarrierContact::surface;
  }

  double largest_pair_cutoff() const {
    double cut = 0;
    const double lj = contact::lj_cutoff_over_sigma;
    for (std::size_t i = 0; i < cells_; ++i)
      for (std::size_t j = i; j < cells_; ++j)
        cut = std::max({cut, lj * length(cell_sigma(c_, system_.models[i], system_.models[j])),
                        c_.contact.morse_depth > 0 ? length(c_.contact.morse_cutoff) : 0.0});
    if (cells_ > 0 && carriers_ > 0 && !surface_contact())
      cut = std::max(cut, lj * length(c_.contact.carrier_sigma));
    if (carriers_ > 0 && c_.magnetic.dipoles) cut = std::max(cut, dipole_cutoff(c_));
    return cut;
  }

  void bonded_styles() {
    if (cells_ > 0) {
      line("bond_style %s", worms_ ? "hybrid hemo/wlc harmonic" : "hemo/wlc");
      line("angle_style %s", worms_ ? "hybrid hemo/membrane harmonic" : "hemo/membrane");
      line("dihedral_style hemo/bend");
    } else if (worms_) {
      line("bond_style harmonic\nangle_style harmonic");
    }
  }

  void group(const char* name, std::size_t first, std::size_t count) {
    if (count == 0) return;
    append("group %s type", name);
    for (std::size_t k = 0; k < count; ++k) append(" %zu", first + k);
    t_ += "\n";
  }

  void groups() {
    group("cells", 1, cells_);
    group("carriers", cells_ + 1, carriers_);
    line("neigh_modify every 1 delay 0 check yes");
    if (cells_ > 0) line("neigh_modify exclude molecule/intra cells");
  }

  void pairs() {
    const bool contact = cells_ > 0, dipole = carriers_ > 0 && c_.magnetic.dipoles;
    if (!contact && !dipole) {
      line("pair_style zero %g\npair_coeff * *", 1.0);
      return;
    }
    if (contact && carriers_ > 0) {
      if (dipole)
        line("pair_style hybrid hemo/contact hemo/dipole %.9g", dipole_cutoff(c_));
      else
        line("pair_style hybrid hemo/contact");
    } else if (contact) {
      line("pair_style hemo/contact");
    } else {
      line("pair_style hemo/dipole %.9g", dipole_cutoff(c_));
    }
    const bool hybrid = contact && carriers_ > 0;
    cell_pairs(hybrid ? "hemo/contact " : "");
    carrier_pairs(hybrid ? "hemo/dipole " : "", dipole);
  }

  void cell_pairs(const char* style) {
    const auto& k = c_.contact;
    const double thermal = kBT / units_.energy();
    // Contact energies are given for a red cell of 3286 vertices.
    const auto finer = [&](std::size_t m) { return system_.models[m].vertex_share; };
    for (std::size_t i = 0; i < cells_; ++i) {
      for (std::size_t j = i; j < cells_; ++j) {
        const double scale = finer(i) * finer(j) * thermal;
        append("pair_coeff %zu %zu %s", i + 1, j + 1, style);
        if (k.morse_depth > 0)
          append("morse %.9g %.9g %.9g %.9g ", k.morse_depth * scale, k.morse_beta * units_.dx,
                 length(k.morse_r0), length(k.morse_cutoff));
        append("lj %.9g %.9g\n", k.epsilon * scale,
               length(cell_sigma(c_, system_.models[i], system_.models[j])));
      }
      for (std::size_t b = 0; b < carriers_; ++b)
        if (surface_contact())
          line("pair_coeff %zu %zu none", i + 1, cells_ + b + 1);
        else
          line("pair_coeff %zu %zu %slj %.9g %.9g", i + 1, cells_ + b + 1, style,
               k.epsilon * finer(i) * thermal, length(k.carrier_sigma));
    }
  }

  void carrier_pairs(const char* style, bool dipole) {
    for (std::size_t a = 0; a < carriers_; ++a)
      for (std::size_t b = a; b < carriers_; ++b) {
        const std::size_t i = cells_ + a + 1, j = cells_ + b + 1;
        if (!dipole) {
          line("pair_coeff %zu %zu none", i, j);
          continue;
        }
        const double contact = length(c_.carriers[a].radius + c_.carriers[b].radius);
        if (c_.contact.repulsion == Repulsion::soft)
          line("pair_coeff %zu %zu %s%.9g soft %g", i, j, style, contact,
               c_.contact.repulsion_kappa);
        else  // Eq. 26: epsilon = 0.1 kBT, sigma = 0.1 a
          line("pair_coeff %zu %zu %s%.9g paper %.9g %.9g", i, j, style, contact,
               0.1 * kBT / units_.energy(), 0.05 * contact);
      }
  }

  [[gnu::format(printf, 2, 3)]] void append(const char* format, ...) {
    va_list args;
    va_start(args, format);
    add(format, args);
    va_end(args);
  }

  [[gnu::format(printf, 2, 3)]] void line(const char* format, ...) {
    va_list args;
    va_start(args, format);
    add(format, args);
    va_end(args);
    t_ += '\n';
  }

  void add(const char* format, va_list args) {
    char buffer[1024];
    std::vsnprintf(buffer, sizeof buffer, format, args);
    t_ += buffer;
  }

  void fixes() {
    if (cells_ > 0) line("fix advect cells hemo/advect");
    if (carriers_ > 0) {
      t_ += "fix drag carriers hemo/drag";
      for (std::size_t b = 0; b < carriers_; ++b)
        append(" radius %zu %.9g", cells_ + b + 1, length(c_.carriers[b].radius));
      const double mass_unit = units_.mass();
      for (std::size_t b = 0; b < carriers_; ++b)
        if (const double m = inertial_mass(c_, c_.carriers[b]); m > 0)
          append(" inertia %zu %.9g", cells_ + b + 1, m / mass_unit);
      line(" feedback %s", c_.carriers[0].feedback ? "yes" : "no");
      field();
      if (surface_contact())
        line("fix contact carriers hemo/contact range %.9g stiffness %.9g",
             length(c_.contact.surface_range), c_.contact.surface_stiffness / units_.tension());
    }
    walls();
    fluid();
  }

  void field() {
    t_ += "fix field carriers hemo/field";
    for (std::size_t b = 0; b < carriers_; ++b) {
      const auto law = magnetisation(c_, c_.carriers[b]);
      append(" susceptibility %zu %.9g", cells_ + b + 1, law.chi_volume);
      if (law.saturation > 0) append(" saturation %zu %.9g", cells_ + b + 1, law.saturation);
    }
    for (const std::string& word : field_words(c_)) t_ += " " + word;
    t_ += "\n";
  }

  void walls() {
    if (c_.channel.boundary == Boundary::periodic || cells_ + carriers_ == 0) return;
    const double sigma = length(c_.contact.plate_sigma), epsilon = kBT / units_.energy();
    const double cut = contact::lj_cutoff_over_sigma * sigma;
    if (in_vessel(c_))
      line("fix walls all hemo/wall %.9g %.9g %.9g", epsilon, sigma, cut);
    else
      line("fix plates all wall/lj126 zlo EDGE %.9g %.9g %.9g zhi EDGE %.9g %.9g %.9g", epsilon,
           sigma, cut, epsilon, sigma, cut);
  }

  void fluid() {
    append("fix fluid all hemo/fluid tau %.12g scheme %s kernel %s", c_.numerics.tau,
           c_.numerics.scheme.c_str(), c_.numerics.kernel.c_str());
    if (c_.numerics.precision != "double") append(" precision %s", c_.numerics.precision.c_str());
    if (c_.channel.boundary == Boundary::plates) moving_plates();
    if (c_.channel.boundary == Boundary::tube) tube();
    if (c_.channel.boundary == Boundary::voxels)
      append(" surface %s %.12g", geometry_copy(c_).c_str(), surface_scale(c_));
    drive();
    t_ += "\n";
  }

  void moving_plates() {
    const auto v = plate_velocity(c_);
    append(" plates z lower 0 %.12g 0 upper 0 %.12g 0", v[0] / units_.velocity(),
           v[1] / units_.velocity());
    if (c_.channel.shear_rate != 0) append(" initial linear");
  }

  void tube() {
    append(" tube %c", "xyz"[c_.channel.axis]);
    for (int d = 0; d < 3; ++d)
      if (d != c_.channel.axis)
        append(" %.12g", length(c_.channel.size[static_cast<std::size_t>(d)]) / 2);
    append(" %.12g", length(c_.channel.diameter) / 2);
  }

  void drive() {
    double g[3] = {0, 0, 0};
    for (std::size_t d = 0; d < 3; ++d) g[d] = c_.channel.body_force[d] / units_.force_density();
    if (c_.channel.mean_velocity) {
      g[c_.channel.axis] = starting_force(c_) / units_.force_density();
      append(" mean_velocity %c %.12g", "xyz"[c_.channel.axis],
             *c_.channel.mean_velocity / units_.velocity());
    }
    if (g[0] != 0 || g[1] != 0 || g[2] != 0) append(" force %.12g %.12g %.12g", g[0], g[1], g[2]);
  }

  void observers() {
    const double dx_um = units_.dx * 1e6;
    if (carriers_ > 0) {
      line("compute margination carriers hemo/margination layer %.9g walls %s",
           length(c_.analysis.layer), layer_walls(c_.analysis.walls));
      // Without a series the first and the last row remain: a run always has its probability.
      line(
          "fix series all hemo/series %ld margination margination.csv dt_s %.12g average_from %.9g",
          c_.output.series ? steps_in(*c_.output.series, units_) : steps(c_), units_.dt,
          c_.analysis.average_from);
    }
    if (c_.output.fields)
      line("fix snapshot all hemo/snapshot %ld fields dx_um %.12g dt_s %.12g",
           steps_in(*c_.output.fields, units_), dx_um, units_.dt);
    if (cells_ > 0 && c_.output.cells) {
      line("compute cells cells hemo/cell");
      // Turns are counted at every look of the watch: a membrane hardly moves between two.
      line("fix cells all hemo/cells %ld cells cells.csv dx_um %.12g dt_s %.12g follow %d",
           steps_in(*c_.output.cells, units_), dx_um, units_.dt, watch_every);
    }
    if (c_.output.profiles)
      line("fix profiles all hemo/profiles %ld profiles.csv series layer.csv dx_um %.12g dt_s "
           "%.12g stress_pa %.12g average_from %.9g",
           steps_in(*c_.output.profiles, units_), dx_um, units_.dt, units_.pressure(),
           c_.analysis.average_from);
    append("fix watch all hemo/watch %d mach_max 0.3", watch_every);
    if (cells_ > 0) append(" cells cells");
    if (carriers_ > 0) append(" carriers carriers");
    if (cells_ > 0 && carriers_ > 0) append(" inside_looks %d", inside_looks);
    line(" inspection inspection %.12g %.12g", dx_um, units_.dt);
  }

  /// Last: what other fixes know at the end of a step is then known.
  void checkpoints(const Saving& saving) {
    t_ += "fix checkpoint all hemo/checkpoint checkpoint interval ";
    if (c_.run.checkpoint)
      append("%.9g", *c_.run.checkpoint);
    else
      t_ += "never";
    append(" every %d keep case.toml", watch_every);
    if (!saving.resume.empty())
      append(" resume %s wall %.9g", saving.resume.c_str(), saving.wall_s);
    t_ += "\n";
  }

  const Case& c_;
  const System& system_;
  LatticeUnits units_;
  std::size_t cells_, carriers_;
  bool worms_ = false;
  std::string t_;
};

}  // namespace

std::string lammps_script(const Case& c, const System& system) {
  return Script(c, system).write(std::nullopt);
}

std::string saving_script(const Case& c, const System& system) {
  return Script(c, system).write(Script::Saving{});
}

std::string resumed_script(const Case& c, const System& models, const std::string& checkpoint,
                           double wall_s) {
  return Script(c, models).write(Script::Saving{checkpoint, wall_s});
}

double dipole_cutoff(const Case& c) {
  double radius = 0;
  for (const Carrier& carrier : c.carriers) radius = std::max(radius, carrier.radius);
  return dipole_radii * radius / c.numerics.dx;
}

double cell_sigma(const Case& c, const CellModel& a, const CellModel& b) {
  return c.contact.cell_sigma.value_or(
      std::max(0.25e-6, 0.6 * std::max(a.longest_edge, b.longest_edge)));
}

}  // namespace hemomag::case_
