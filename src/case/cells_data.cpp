#include "case/cells_data.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>

#include "case/lattice_units.hpp"
#include "membrane/bending.hpp"

namespace hemomag::case_ {
namespace {

/// Appends printf-formatted lines.
class Lines {
public:
  template <class... Args> void operator()(const char* format, Args... args) {
    char line[512];
    std::snprintf(line, sizeof line, format, args...);
    text += line;
    text += '\n';
  }
  void operator()(const char* plain) {
    text += plain;
    text += '\n';
  }
  std::string text;
};

struct Counts {
  long atoms = 0, bonds = 0, angles = 0, dihedrals = 0;
};

class Writer {
public:
  Writer(const Case& c, const System& system) : c_(c), system_(system), units_(lattice_units(c)) {
    for (const Carrier& carrier : c.carriers)
      if (carrier.kind == CarrierKind::worm) ++worms_;
    Counts at;
    for (const CellModel& m : system.models) {
      first_type_.push_back(at);
      at.bonds += static_cast<long>(m.topology.edges.size());
      at.angles += static_cast<long>(m.mesh.triangles.size());
      at.dihedrals += static_cast<long>(m.topology.hinges.size());
    }
    types_ = at;
    hybrid_ = worms_ > 0 && !system.models.empty();
  }

  std::string write() {
    header();
    coefficients();
    atoms();
    topology();
    return out_.text;
  }

  /// The coefficients as commands of a script.
  std::string commands() {
    coefficients();
    std::stringstream sections(out_.text);
    std::string text, command;
    for (std::string line; std::getline(sections, line);) {
      if (line.empty()) continue;
      if (const auto title = line.find(" Coeffs"); title != std::string::npos) {
        command = line.substr(0, title) + "_coeff ";
        command[0] = static_cast<char>(std::tolower(command[0]));
      } else {
        text += command + line + "\n";
      }
    }
    return text;
  }

private:
  Counts totals() const {
    Counts n;
    for (const auto& cell : system_.cells) {
      const CellModel& m = system_.models[cell.model];
      n.atoms += static_cast<long>(cell.x.size());
      n.bonds += static_cast<long>(m.topology.edges.size());
      n.angles += static_cast<long>(m.mesh.triangles.size());
      n.dihedrals += static_cast<long>(m.topology.hinges.size());
    }
    for (const auto& carrier : system_.carriers) {
      const auto beads = static_cast<long>(carrier.beads.size());
      n.atoms += beads;
      n.bonds += beads - 1;
      if (beads > 2) n.angles += beads - 2;
    }
    return n;
  }

  void header() {
    const Counts n = totals();
    const auto size = nodes(c_);
    out_("hemomag: %s\n", c_.title.c_str());
    out_("%ld atoms\n%ld bonds\n%ld angles\n%ld dihedrals\n", n.atoms, n.bonds, n.angles,
         n.dihedrals);
    out_("%zu atom types\n%ld bond types\n%ld angle types\n%ld dihedral types\n",
         std::max<std::size_t>(1, c_.cells.size() + c_.carriers.size()),  // LAMMPS wants one
         types_.bonds + worms_, types_.angles + worms_, types_.dihedrals);
    out_("0 %d xlo xhi\n0 %d ylo yhi\n0 %d zlo zhi", size[0], size[1], size[2]);
  }

  void coefficients() {
    const char* bond_style = hybrid_ ? " hemo/wlc" : "";
    const char* angle_style = hybrid_ ? " hemo/membrane" : "";
    if (types_.bonds + worms_ > 0) out_("\nBond Coeffs\n");
    long type = 0;
    for (std::size_t m = 0; m < system_.models.size(); ++m)
      for (const double rest : system_.models[m].rest_length)
        out_("%ld%s %.17g %.17g %.17g %.17g 2 0 0", ++type, bond_style, kBT / units_.energy(),
             c_.cells[m].stretch_ratio, rest / c_.cells[m].stretch_ratio / units_.dx,
             c_.cells[m].shear_modulus / units_.tension());
    worm_coefficients(type, [&](const Carrier& w, long t) {
      out_("%ld%s %.17g %.17g", t, hybrid_ ? " harmonic" : "", w.stretching / units_.tension(),
           2 * w.radius / units_.dx);
    });

    if (types_.angles + worms_ > 0) out_("\nAngle Coeffs\n");
    type = 0;
    for (std::size_t m = 0; m < system_.models.size(); ++m) {
      const CellModel& model = system_.models[m];
      const Cell& cell = c_.cells[m];
      const double dx2 = units_.dx * units_.dx;
      for (const auto& t : model.mesh.triangles) {
        const auto& x = model.mesh.x;
        const Vec3 a = x[static_cast<std::size_t>(t[0])], b = x[static_cast<std::size_t>(t[1])],
                   d = x[static_cast<std::size_t>(t[2])];
        out_("%ld%s 0 1 %.17g %.17g %.17g %.17g %.17g %.17g", ++type, angle_style,
             cell.area_modulus_global / units_.tension(), model.area / dx2,
             cell.volume_modulus / units_.pressure(), model.volume / (dx2 * units_.dx),
             cell.area_modulus_local / units_.tension(), 0.5 * norm(cross(b - a, d - a)) / dx2);
      }
    }
    worm_coefficients(type, [&](const Carrier& w, long t) {
      out_("%ld%s %.17g 180", t, hybrid_ ? " harmonic" : "", w.bending / units_.energy());
    });

    if (types_.dihedrals > 0) out_("\nDihedral Coeffs\n");
    type = 0;
    for (std::size_t m = 0; m < system_.models.size(); ++m)
      for (const auto& h : system_.models[m].topology.hinges) {
        const auto& x = system_.models[m].mesh.x;
        const double theta = membrane::make_hinge(x[static_cast<std::size_t>(h[0])],
                                                  x[static_cast<std::size_t>(h[1])],
                                                  x[static_cast<std::size_t>(h[2])],
                                                  x[static_cast<std::size_t>(h[3])])
                                 .theta.angle();
        out_("%ld %.17g %.17g", ++type, c_.cells[m].bending_modulus / units_.energy(),
             c_.cells[m].hinges == Hinges::rest ? theta * 180 / std::numbers::pi : 0.0);
      }
  }

  template <class Print> void worm_coefficients(long type, Print print) {
    for (const Carrier& carrier : c_.carriers)
      if (carrier.kind == CarrierKind::worm) print(carrier, ++type);
  }

  void atom(long molecule, std::size_t type, const Vec3& x) {
    const auto size = nodes(c_);
    double wrapped[3];
    int image[3];
    for (std::size_t d = 0; d < 3; ++d) {
      const bool periodic = d < 2 || c_.channel.boundary != Boundary::plates;
      const double at = x[d] / units_.dx;
      image[d] = periodic ? static_cast<int>(std::floor(at / size[d])) : 0;
      wrapped[d] = at - image[d] * size[d];
    }
    out_("%ld %ld %zu %.17g %.17g %.17g %d %d %d", ++id_, molecule, type, wrapped[0], wrapped[1],
         wrapped[2], image[0], image[1], image[2]);
  }

  void atoms() {
    if (totals().atoms == 0) return;
    out_("\nAtoms # molecular\n");
    long molecule = 0;
    for (const auto& cell : system_.cells) {
      ++molecule;
      for (const Vec3& x : cell.x) atom(molecule, cell.model + 1, x);
    }
    for (const auto& carrier : system_.carriers) {
      const bool worm = c_.carriers[carrier.entry].kind == CarrierKind::worm;
      if (worm) ++molecule;
      for (const Vec3& x : carrier.beads)
        atom(worm ? molecule : 0, c_.cells.size() + carrier.entry + 1, x);
    }
  }

  /// visit(first atom of the chain, beads, number of the worm entry)
  template <class Visit> void for_each_worm(long first, Visit visit) {
    std::vector<long> number(c_.carriers.size(), 0);
    long worm_entries = 0;
    for (std::size_t entry = 0; entry < c_.carriers.size(); ++entry)
      if (c_.carriers[entry].kind == CarrierKind::worm) number[entry] = ++worm_entries;
    for (const auto& carrier : system_.carriers) {
      const auto beads = static_cast<long>(carrier.beads.size());
      if (number[carrier.entry] > 0) visit(first, beads, number[carrier.entry]);
      first += beads;
    }
  }

  void topology() {
    const Counts n = totals();
    long carriers_from = 1;
    for (const auto& cell : system_.cells) carriers_from += static_cast<long>(cell.x.size());

    if (n.bonds > 0) out_("\nBonds\n");
    long row = 0;
    for_each_cell([&](const CellModel& m, const Counts& type, long first) {
      long t = type.bonds;
      for (const auto& e : m.topology.edges)
        out_("%ld %ld %ld %ld", ++row, ++t, first + e.a, first + e.b);
    });
    for_each_worm(carriers_from, [&](long first, long beads, long worm) {
      for (long b = 0; b + 1 < beads; ++b)
        out_("%ld %ld %ld %ld", ++row, types_.bonds + worm, first + b, first + b + 1);
    });

    if (n.angles > 0) out_("\nAngles\n");
    row = 0;
    for_each_cell([&](const CellModel& m, const Counts& type, long first) {
      long t = type.angles;
      for (const auto& k : m.mesh.triangles)
        out_("%ld %ld %ld %ld %ld", ++row, ++t, first + k[0], first + k[1], first + k[2]);
    });
    for_each_worm(carriers_from, [&](long first, long beads, long worm) {
      for (long b = 0; b + 2 < beads; ++b)
        out_("%ld %ld %ld %ld %ld", ++row, types_.angles + worm, first + b, first + b + 1,
             first + b + 2);
    });

    if (n.dihedrals > 0) out_("\nDihedrals\n");
    row = 0;
    for_each_cell([&](const CellModel& m, const Counts& type, long first) {
      long t = type.dihedrals;
      for (const auto& h : m.topology.hinges)
        out_("%ld %ld %ld %ld %ld %ld", ++row, ++t, first + h[0], first + h[1], first + h[2],
             first + h[3]);
    });
  }

  /// visit(model, types used before it, first atom)
  template <class Visit> void for_each_cell(Visit visit) {
    long first = 1;
    for (const auto& cell : system_.cells) {
      visit(system_.models[cell.model], first_type_[cell.model], first);
      first += static_cast<long>(cell.x.size());
    }
  }

  const Case& c_;
  const System& system_;
  LatticeUnits units_;
  long worms_ = 0;  // [[carrier]] entries that are worms
  bool hybrid_ = false;
  std::vector<Counts> first_type_;
  Counts types_;
  long id_ = 0;
  Lines out_;
};

}  // namespace

std::string cells_data(const Case& c, const System& system) { return Writer(c, system).write(); }

std::string coefficient_commands(const Case& c, const System& models) {
  return Writer(c, models).commands();
}

}  // namespace hemomag::case_
