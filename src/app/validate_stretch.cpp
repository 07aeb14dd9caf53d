#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/published.hpp"
#include "app/stretching.hpp"
#include "app/validation.hpp"
#include "io/figure.hpp"
#include "io/files.hpp"
#include "membrane/mesh.hpp"

// Stretching by optical tweezers, quasi-static: Figs. 4a and 4b.

namespace hemomag::app {
namespace {

constexpr int fine = 3286, coarse = 642;
constexpr std::uint64_t seed = 1;
constexpr double mesh_tolerance = 0.02;        // relative, 642 against 3286 vertices
constexpr double direction_tolerance = 0.015;  // relative, among pulls at 0, 45, 90 degrees
constexpr double authors_tolerance = 0.015;    // relative, to the authors' own mesh
constexpr double area_limit = 0.015, volume_limit = 0.007;
constexpr double rms_A = 0.05, rms_T = 0.20, worst_sd_A = 1.0, worst_sd_T = 1.3;
constexpr const char* mills = "Mills et al. 2004";

std::vector<double> all_forces() {
  std::vector<double> forces{0, 25, 50, 68, 75, 100, 125, 150, 175, 200};
  for (const auto& p : mills_2004) forces.push_back(p.force);
  std::sort(forces.begin(), forces.end());
  forces.erase(std::unique(forces.begin(), forces.end()), forces.end());
  return forces;
}

const Stretched& at(const std::vector<Stretched>& curve, double force) {
  return *std::find_if(curve.begin(), curve.end(),
                       [&](const Stretched& s) { return s.force == force; });
}

/// A curve against the experiment.
struct Agreement {
  double rms_A = 0, rms_T = 0;      ///< relative, over the points under load
  double worst_A = 0, worst_T = 0;  ///< in standard deviations, over all points
  int within_A = 0, within_T = 0;   ///< points within one
};

Agreement agreement(const std::vector<Stretched>& curve) {
  Agreement a;
  for (const auto& p : mills_2004) {
    const Stretched& s = at(curve, p.force);
    const double off_A = std::fabs(s.D_A - p.D_A) / p.sd_A;
    const double off_T = std::fabs(s.D_T - p.D_T) / p.sd_T;
    a.worst_A = std::max(a.worst_A, off_A);
    a.worst_T = std::max(a.worst_T, off_T);
    a.within_A += off_A <= 1;
    a.within_T += off_T <= 1;
    if (p.force == 0) continue;
    a.rms_A += std::pow(s.D_A / p.D_A - 1, 2);
    a.rms_T += std::pow(s.D_T / p.D_T - 1, 2);
  }
  const double loaded = mills_2004.size() - 1;
  a.rms_A = std::sqrt(a.rms_A / loaded);
  a.rms_T = std::sqrt(a.rms_T / loaded);
  return a;
}

using Kind = Finding::Kind;

Finding at_most(std::string quantity, double measured, double limit, const char* source,
                Kind kind = Kind::gate) {
  return {"stretch", std::move(quantity), measured, 0, limit, "", source, kind};
}

void against_mills(const std::vector<Stretched>& curve, std::vector<Finding>& found) {
  const Agreement a = agreement(curve);
  found.push_back(
      at_most("D_A, largest distance from the mean, s.d.", a.worst_A, worst_sd_A, mills));
  found.push_back(at_most("D_A, root mean square deviation", a.rms_A, rms_A, mills));
  found.push_back(
      at_most("D_T, largest distance from the mean, s.d.", a.worst_T, worst_sd_T, mills));
  found.push_back(at_most("D_T, root mean square deviation", a.rms_T, rms_T, mills));
  found.push_back({"stretch", "D_A, points within one s.d.", static_cast<double>(a.within_A), 13, 0,
                   "", mills});
  // The isotropic answer at the printed mu0: 7 of 13, as on the authors' own mesh.
  found.push_back({"stretch", "D_T, points within one s.d.", static_cast<double>(a.within_T), 13, 0,
                   "", mills, Kind::shortfall});
}

/// A softer cell meets every point: the printed constant, not the model, is what D_T misses.
void sensitivity(const membrane::TriangleMesh& mesh, const std::vector<double>& forces,
                 std::vector<Finding>& found) {
  auto soft = table_1();
  soft.mu0 = 5.0;
  constexpr double wide_grip = 0.05;
  const Agreement a = agreement(stretch(mesh, soft, forces, {wide_grip, 0}));
  found.push_back({"stretch", "sensitivity mu0 = 5.0 uN/m, 5 % held: points within one s.d.",
                   static_cast<double>(a.within_A + a.within_T), 26, 0, "", mills});
  const Agreement b = agreement(stretch(mesh, table_1(), forces, {wide_grip, 0}));
  found.push_back(printed("stretch", "sensitivity 5 % held: points of D_A within one s.d.",
                          b.within_A, 13, "", mills));
  found.push_back(printed("stretch", "sensitivity 5 % held: points of D_T within one s.d.",
                          b.within_T, 13, "", mills));
}

struct Directions {
  double worst_A = 0, worst_T = 0;     ///< largest spread over the mean, of any force
  std::vector<double> mean_A, mean_T;  ///< of each force
};

constexpr double compared_forces[] = {50, 100, 150, 200};

Directions directions(const membrane::TriangleMesh& mesh, const std::vector<double>& forces) {
  std::vector<std::vector<Stretched>> pulls;
  for (const double direction : {0.0, 45.0, 90.0})
    pulls.push_back(stretch(mesh, table_1(), forces, {0.02, direction}));
  Directions d;
  for (const double force : compared_forces) {
    const auto spread = [&](double Stretched::*extent, std::vector<double>& means) {
      double low = 1e9, high = 0, sum = 0;
      for (const auto& pull : pulls) {
        const double v = at(pull, force).*extent;
        low = std::min(low, v), high = std::max(high, v), sum += v / 3;
      }
      means.push_back(sum);
      return (high - low) / sum;
    };
    d.worst_A = std::max(d.worst_A, spread(&Stretched::D_A, d.mean_A));
    d.worst_T = std::max(d.worst_T, spread(&Stretched::D_T, d.mean_T));
  }
  return d;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] / b[i] - 1));
  return worst;
}

double largest_difference(const std::vector<Stretched>& a, const std::vector<Stretched>& b,
                          double Stretched::*extent) {
  double worst = 0;
  for (const double force : compared_forces)
    worst = std::max(worst, std::fabs(at(a, force).*extent / (at(b, force).*extent) - 1));
  return worst;
}

void meshes_and_directions(const std::vector<Stretched>& fine_curve,
                           const std::vector<Stretched>& coarse_curve,
                           const membrane::TriangleMesh& fine_mesh,
                           const membrane::TriangleMesh& coarse_mesh, std::vector<Finding>& found) {
  const std::vector<double> forces{0, 25, 50, 75, 100, 125, 150, 175, 200};
  const Directions f = directions(fine_mesh, forces), c = directions(coarse_mesh, forces);
  const char* spread = "isotropic network";
  const char* meshes = "the same cell";
  found.push_back(at_most("3286 vertices, D_A of pulls at 0, 45, 90 degrees, spread", f.worst_A,
                          direction_tolerance, spread));
  found.push_back(at_most("3286 vertices, D_T of pulls at 0, 45, 90 degrees, spread", f.worst_T,
                          direction_tolerance, spread));
  // Of 642 vertices 13 are held at each end, and where these few lie decides D_A by a per cent or
  // two: known misses.
  found.push_back(at_most("642 vertices, D_A of pulls at 0, 45, 90 degrees, spread", c.worst_A,
                          direction_tolerance, spread, Kind::shortfall));
  found.push_back(at_most("642 vertices, D_T of pulls at 0, 45, 90 degrees, spread", c.worst_T,
                          direction_tolerance, spread));
  found.push_back(at_most("642 against 3286 vertices, D_A, mean of the three pulls",
                          largest_difference(c.mean_A, f.mean_A), mesh_tolerance, meshes));
  found.push_back(at_most("642 against 3286 vertices, D_T, mean of the three pulls",
                          largest_difference(c.mean_T, f.mean_T), mesh_tolerance, meshes));
  found.push_back(at_most("642 against 3286 vertices, D_A, one pull each",
                          largest_difference(coarse_curve, fine_curve, &Stretched::D_A),
                          mesh_tolerance, meshes, Kind::shortfall));
  found.push_back(at_most("642 against 3286 vertices, D_T, one pull each",
                          largest_difference(coarse_curve, fine_curve, &Stretched::D_T),
                          mesh_tolerance, meshes));
}

/// How much the mesh's seed alone decides at 642 vertices.
void seeds(std::vector<Finding>& found) {
  constexpr int meshes = 5;
  double low_A = 1e9, high_A = 0, low_T = 1e9, high_T = 0;
  for (int k = 1; k <= meshes; ++k) {
    const auto mesh = membrane::red_cell_mesh(coarse, rest_diameter, static_cast<std::uint64_t>(k));
    const Stretched s = stretch(mesh, table_1(), {0, 50, 100}, {}).back();
    low_A = std::min(low_A, s.D_A), high_A = std::max(high_A, s.D_A);
    low_T = std::min(low_T, s.D_T), high_T = std::max(high_T, s.D_T);
  }
  const char* source = "the same cell";
  found.push_back(printed("stretch", "642 vertices, five seeds, D_A at 100 pN, spread",
                          2 * (high_A - low_A) / (high_A + low_A), 0, "", source));
  found.push_back(printed("stretch", "642 vertices, five seeds, D_T at 100 pN, spread",
                          2 * (high_T - low_T) / (high_T + low_T), 0, "", source));
}

void against_authors_mesh(const std::vector<Stretched>& curve, std::vector<Finding>& found) {
  for (const auto& p : authors_mesh) {
    char head[48];
    std::snprintf(head, sizeof head, "3286 vertices at %g pN, ", p.force);
    const char* source = "quasi-static, the authors' own mesh";
    found.push_back({"stretch", std::string(head) + "D_A", at(curve, p.force).D_A, p.D_A,
                     authors_tolerance * p.D_A, "um", source});
    found.push_back({"stretch", std::string(head) + "D_T", at(curve, p.force).D_T, p.D_T,
                     authors_tolerance * p.D_T, "um", source});
  }
}

void write_curves(const std::string& out, const std::vector<Stretched>& fine_curve,
                  const std::vector<Stretched>& coarse_curve) {
  io::CsvFile csv(out + "/stretch.csv", "vertices,force_pN,D_A_um,D_T_um,D_z_um,area_change,"
                                        "volume_change,largest_extension,residual_pN");
  for (const auto* curve : {&fine_curve, &coarse_curve})
    for (const Stretched& s : *curve)
      csv.row({static_cast<double>(s.x.size()), s.force, s.D_A, s.D_T, s.D_z, s.area_change,
               s.volume_change, s.extension, s.residual});
}

void draw_curves(const std::string& out, const std::vector<Stretched>& fine_curve,
                 const std::vector<Stretched>& coarse_curve) {
  using enum io::Series::Style;
  const auto ours = [](const std::vector<Stretched>& curve, double Stretched::*extent,
                       const char* label, const char* colour, io::Series::Style style) {
    io::Series s{label, colour, {}, {}, {}, style};
    for (const Stretched& state : curve) s.x.push_back(state.force), s.y.push_back(state.*extent);
    return s;
  };
  io::Series axial{"Mills et al. 2004", "black", {}, {}, {}, circles}, across = axial;
  for (const auto& p : mills_2004) {
    axial.x.push_back(p.force), axial.y.push_back(p.D_A), axial.spread.push_back(p.sd_A);
    across.x.push_back(p.force), across.y.push_back(p.D_T), across.spread.push_back(p.sd_T);
  }
  io::Series fedosov_A{"Fedosov et al. 2010", "#2e8b57", {}, {}, {}, dashes}, fedosov_T = fedosov_A;
  for (const auto& p : fedosov_2010) {
    fedosov_A.x.push_back(p.force), fedosov_A.y.push_back(p.D_A);
    fedosov_T.x.push_back(p.force), fedosov_T.y.push_back(p.D_T);
  }
  const auto diagram = [&](const char* title, double Stretched::*extent, const io::Series& points,
                           const io::Series& dashed, std::vector<double> range) {
    return io::Diagram{title,
                       "force (pN)",
                       "diameter (um)",
                       {points, dashed, ours(fine_curve, extent, "3286 vertices", "#c0392b", line),
                        ours(coarse_curve, extent, "642 vertices", "#1f77b4", line)},
                       {0, 210},
                       std::move(range)};
  };
  io::replace_file(
      out + "/stretch_4b.svg",
      io::draw_diagrams(
          {diagram("axial diameter D_A", &Stretched::D_A, axial, fedosov_A, {6, 22}),
           diagram("transverse diameter D_T", &Stretched::D_T, across, fedosov_T, {2, 12})}));
}

void draw_shapes(const std::string& out, const membrane::TriangleMesh& mesh,
                 const std::vector<Stretched>& curve) {
  std::vector<io::Body> bodies;
  for (const double force : {0.0, 68.0, 100.0}) {
    io::Body body;
    char label[32];
    std::snprintf(label, sizeof label, "%g pN", force);
    body.label = label;
    for (const Vec3& p : at(curve, force).x) body.x.push_back({p.x, p.y, p.z});
    body.triangles = mesh.triangles;
    bodies.push_back(std::move(body));
  }
  constexpr double tilt = 50, bar = 5;
  io::replace_file(out + "/stretch_4a.svg", io::draw_bodies(bodies, tilt, bar, "5 um"));
}

std::vector<Finding> stretch_quasi_static(const std::string& out) {
  const auto forces = all_forces();
  const auto fine_mesh = membrane::red_cell_mesh(fine, rest_diameter, seed);
  const auto coarse_mesh = membrane::red_cell_mesh(coarse, rest_diameter, seed);
  const auto fine_curve = stretch(fine_mesh, table_1(), forces, {});
  const auto coarse_curve = stretch(coarse_mesh, table_1(), forces, {});

  io::make_directory(out);
  write_curves(out, fine_curve, coarse_curve);
  draw_curves(out, fine_curve, coarse_curve);
  draw_shapes(out, fine_mesh, fine_curve);

  std::vector<Finding> found;
  against_authors_mesh(fine_curve, found);
  against_mills(fine_curve, found);
  sensitivity(fine_mesh, forces, found);
  double area = 0, volume = 0;
  for (const auto* curve : {&fine_curve, &coarse_curve})
    for (const Stretched& s : *curve) {
      area = std::max(area, std::fabs(s.area_change));
      volume = std::max(volume, std::fabs(s.volume_change));
    }
  found.push_back(at_most("largest change of area up to 200 pN", area, area_limit, "at rest"));
  found.push_back(
      at_most("largest change of volume up to 200 pN", volume, volume_limit, "at rest"));
  meshes_and_directions(fine_curve, coarse_curve, fine_mesh, coarse_mesh, found);
  seeds(found);
  return found;
}

}  // namespace

std::vector<Validation> stretch_validations() {
  return {{"stretch", "a red cell between optical tweezers, quasi-static", stretch_quasi_static}};
}

}  // namespace hemomag::app
