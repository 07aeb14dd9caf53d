#include "case/packing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

#include "analysis/inside.hpp"
#include "base/error.hpp"
#include "case/lattice_units.hpp"
#include "case/script.hpp"
#include "lattice/surface_gaps.hpp"
#include "membrane/mesh_map.hpp"
#include "solver/crowd.hpp"

// Lengths in um and forces in pN within this file, so that numbers are of order one.

namespace hemomag::case_ {
namespace {

constexpr double um = 1e-6, pN = 1e-12;
constexpr double wall_gap = 0.3;           // of vertices from walls, as with every placement
constexpr double loose_hematocrit = 0.15;  // that random placement reaches at once
constexpr double least_stretch = 2;        // the paper's "about two times" the channel
constexpr double start_scale = 0.5;        // of growing cells
constexpr double plate_move = 0.01;        // um a step
constexpr int growth_steps = 1000;
constexpr double damping = 0.5;          // per unit of the crowd's time
constexpr double force_at_rest = 0.02;   // pN on a vertex: kBT over 0.2 um
constexpr int relaxation_steps = 4000;   // at most
constexpr double largest_change = 0.01;  // of area and volume
constexpr double gap_range = 1;          // um, up to which gaps are measured
// The pair repulsion of the flow run is 4.4 epsilon here.
constexpr double vertex_gap_over_sigma = 0.93;

using Cells = std::vector<System::PlacedCell>;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string placement_key(const Case& c) {
  return position(c, entry_path("cell", 0, c.cells.size()) + ".placement");
}

bool by_plates(const Case& c) { return c.cells[0].placement == Placement::compress; }

std::vector<Vec3> scaled(std::span<const Vec3> x, double by) {
  std::vector<Vec3> y(x.begin(), x.end());
  for (Vec3& p : y) p *= by;
  return y;
}

/// @param vertex_gap  [um]
solver::CrowdModel crowd_model(const Cell& cell, const CellModel& model, double vertex_gap) {
  solver::CrowdModel m;
  m.rest = {scaled(model.mesh.x, 1 / um), model.mesh.triangles};
  m.topology = model.topology;
  for (const double l : model.rest_length) m.rest_length.push_back(l / um);
  constexpr double tension = pN / um;
  m.moduli.mu0 = cell.shear_modulus / tension;
  m.moduli.k_a = cell.area_modulus_global / tension;
  m.moduli.k_d = cell.area_modulus_local / tension;
  m.moduli.k_v = cell.volume_modulus / (tension / um);
  m.moduli.k_b = cell.bending_modulus / (pN * um);
  m.moduli.x0 = cell.stretch_ratio;
  m.moduli.flat_hinges = cell.hinges == Hinges::flat;
  m.vertex_gap = vertex_gap;
  return m;
}

/// Cells of one set of meshes in the channel of a case.
class Packer {
public:
  /// @param meshes  coarser than the case's own, or those
  /// @param models  the case's own, whose pairs repel each other in the run
  /// @param height  of the box [um]
  Packer(const Case& c, const std::vector<CellModel>& meshes, const std::vector<CellModel>& models,
         double height)
      : c_(c), box_{{c.channel.size[0] / um, c.channel.size[1] / um, height},
                    {true, true, c.channel.boundary != Boundary::plates}},
        crowd_(crowd_models(c, meshes, models), box_, {}) {
    if (c.channel.boundary == Boundary::plates) crowd_.set_plates(0, height, wall_gap);
    if (in_vessel(c))
      crowd_.set_wall([&c](const Vec3& x) { return wall_distance(c, um * x) / um; }, wall_gap);
  }

  void add(const Cells& cells) {
    for (const auto& cell : cells) {
      crowd_.add(cell.model, scaled(cell.x, 1 / um));
      model_.push_back(cell.model);
    }
  }

  /// Drive two plates together, from the box's height to `height` about its middle, with the
  /// space between them carrying the cells along.
  void compress(double height) {
    const double middle = 0.5 * box_.size.z;
    const int steps = static_cast<int>(std::ceil((middle - 0.5 * height) / plate_move));
    const double speed = plate_move / crowd_.time_step();
    std::vector<Vec3> drift(crowd_.cells());
    for (int k = 1; k <= steps; ++k) {
      const double half = std::max(0.5 * height, middle - k * plate_move);
      crowd_.set_plates(middle - half, middle + half, wall_gap);
      for (std::size_t n = 0; n < drift.size(); ++n)
        drift[n].z = -speed * (centre(n).z - middle) / half;
      crowd_.step(damping, drift);
    }
    steps_ += steps;
    lower_ = middle - 0.5 * height;
  }

  void grow() {
    for (int k = 1; k <= growth_steps; ++k) {
      crowd_.set_scale(start_scale + (1 - start_scale) * k / growth_steps);
      crowd_.step(damping);
    }
    steps_ += growth_steps;
  }
  void start_small() { crowd_.set_scale(start_scale); }

  void relax() {
    crowd_.stop();
    for (int k = 0; k < relaxation_steps; ++k, ++steps_)
      if ((force_ = crowd_.fire_step()) < force_at_rest) break;
  }

  Cells cells() const {
    Cells all;
    for (std::size_t n = 0; n < crowd_.cells(); ++n) {
      all.push_back({model_[n], {}});
      for (const Vec3& p : crowd_.x(n)) all.back().x.push_back(um * (p - Vec3{0, 0, lower_}));
    }
    return all;
  }
  long steps() const { return steps_; }
  double largest_force() const { return force_ * pN; }

private:
  static std::vector<solver::CrowdModel> crowd_models(const Case& c,
                                                      const std::vector<CellModel>& meshes,
                                                      const std::vector<CellModel>& models) {
    std::vector<solver::CrowdModel> all;
    for (std::size_t m = 0; m < meshes.size(); ++m)
      all.push_back(crowd_model(c.cells[m], meshes[m],
                                vertex_gap_over_sigma * cell_sigma(c, models[m], models[m]) / um));
    return all;
  }
  Vec3 centre(std::size_t n) const {
    Vec3 sum;
    for (const Vec3& p : crowd_.x(n)) sum += p;
    return sum / static_cast<double>(crowd_.x(n).size());
  }

  const Case& c_;
  lattice::PeriodicBox box_;
  solver::Crowd crowd_;
  std::vector<std::size_t> model_;
  double lower_ = 0, force_ = 0;
  long steps_ = 0;
};

/// The case with meshes that are quick to pack.
Case coarser(Case c) {
  for (Cell& cell : c.cells)
    if (!cell.surface) cell.vertices = std::min(cell.vertices, packing_vertices);
  return c;
}

CellModel half_size(CellModel m) {
  for (Vec3& p : m.mesh.x) p *= start_scale;
  m.reach *= start_scale;
  m.contains = [whole = m.contains](const Vec3& p) { return whole(p / start_scale); };
  return m;
}

/// Loose cells: in a space stretched across the plates, or, when they are to grow, of half the
/// size.
Cells scatter(const Case& c, const std::vector<CellModel>& meshes, const std::vector<int>& counts,
              double stretch) {
  if (by_plates(c)) {
    Case wide = c;
    wide.channel.size[2] *= stretch;
    return scatter_cells(wide, meshes, counts);
  }
  std::vector<CellModel> small;
  small.reserve(meshes.size());
  for (const CellModel& m : meshes) small.push_back(half_size(m));
  return scatter_cells(c, small, counts);
}

/// From the meshes that were packed to the case's own.
Cells carry(const Cells& cells, const std::vector<CellModel>& from,
            const std::vector<CellModel>& to) {
  std::vector<membrane::MeshMap> maps;
  for (std::size_t m = 0; m < from.size(); ++m) maps.emplace_back(from[m].mesh, to[m].mesh);
  Cells fine;
  for (const auto& cell : cells) fine.push_back({cell.model, maps[cell.model](cell.x)});
  return fine;
}

/// How many cells of each entry, and what hematocrit they make.
struct Asked {
  std::vector<int> counts;
  double hematocrit = 0;
  int cells() const { return std::accumulate(counts.begin(), counts.end(), 0); }
};

Asked asked_of(const Case& c, const std::vector<CellModel>& models) {
  Asked asked;
  for (std::size_t m = 0; m < models.size(); ++m) {
    asked.counts.push_back(cell_count(c, c.cells[m], models[m]));
    asked.hematocrit += asked.counts.back() * models[m].volume / fluid_volume(c);
  }
  return asked;
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100 * share);
  return text;
}

lattice::PeriodicBox box_of(const Case& c) {
  return {{c.channel.size[0], c.channel.size[1], c.channel.size[2]},
          {true, true, c.channel.boundary != Boundary::plates}};
}

/// The smallest distance of a vertex, or of the middle of an edge, from the walls.
double least_wall_gap(const Case& c, const std::vector<CellModel>& models, const Cells& cells) {
  double least = std::numeric_limits<double>::infinity();
  if (c.channel.boundary == Boundary::periodic) return least;
  const auto gap = [&](const Vec3& p) {
    return in_vessel(c) ? wall_distance(c, p) : std::min(p.z, c.channel.size[2] - p.z);
  };
  for (const auto& cell : cells) {
    for (const Vec3& p : cell.x) least = std::min(least, gap(p));
    for (const auto& e : models[cell.model].topology.edges)
      least = std::min(least, gap(0.5 * (cell.x[static_cast<std::size_t>(e.a)] +
                                         cell.x[static_cast<std::size_t>(e.b)])));
  }
  return least;
}

/// Cells of which a vertex lies inside another. Surfaces that do not cross lie apart or wholly one
/// in the other, so that one vertex tells.
long swallowed(const Case& c, const std::vector<CellModel>& models, const Cells& cells) {
  std::vector<analysis::SurfaceTriangle> triangles;
  std::vector<Vec3> points;
  const auto box = box_of(c);
  std::int64_t first = 0;
  for (const auto& cell : cells) {
    const auto& mesh = models[cell.model].mesh;
    for (const auto& t : mesh.triangles) {
      analysis::SurfaceTriangle s;
      for (std::size_t k = 0; k < 3; ++k) {
        s.x[k] = cell.x[static_cast<std::size_t>(t[k])];
        s.tag[k] = first + t[k];
      }
      triangles.push_back(s);
    }
    first += static_cast<std::int64_t>(cell.x.size());
    // Just outside the first triangle, where the cell's own surface does not count.
    const auto& t = mesh.triangles[0];
    const Vec3 a = cell.x[static_cast<std::size_t>(t[0])],
               b = cell.x[static_cast<std::size_t>(t[1])],
               d = cell.x[static_cast<std::size_t>(t[2])];
    const Vec3 normal = cross(b - a, d - a);
    Vec3 p = (1.0 / 3) * (a + b + d) + (1e-3 * um / norm(normal)) * normal;
    for (std::size_t k = 0; k < 3; ++k)
      if (box.periodic[k]) p[k] -= box.size[k] * std::floor(p[k] / box.size[k]);
    points.push_back(p);
  }
  const auto times = analysis::enclosure(points, triangles, {box.size, box.periodic[2]});
  return std::count_if(times.begin(), times.end(), [](int n) { return n != 0; });
}

/// @throws Error when two surfaces cross, one lies within another, or one passes through a wall
PackingReport check_cells(const Case& c, const std::vector<CellModel>& models, const Cells& cells) {
  std::vector<lattice::SurfaceView> surfaces;
  PackingReport r;
  r.cells = cells.size();
  for (const auto& cell : cells) {
    const CellModel& m = models[cell.model];
    surfaces.push_back({cell.x, m.mesh.triangles});
    r.hematocrit += m.volume / fluid_volume(c);
    const membrane::TriangleMesh mesh{cell.x, m.mesh.triangles};
    r.area_change = std::max(r.area_change, std::fabs(membrane::surface_area(mesh) / m.area - 1));
    r.volume_change =
        std::max(r.volume_change, std::fabs(membrane::enclosed_volume(mesh) / m.volume - 1));
  }
  const auto gaps = lattice::surface_gaps(surfaces, box_of(c), gap_range * um);
  if (gaps.crossings > 0)
    throw Error(std::to_string(gaps.crossings) + " pairs of triangles cross, first of cells " +
                std::to_string(gaps.first_crossing[0] + 1) + " and " +
                std::to_string(gaps.first_crossing[1] + 1));
  r.crossings = gaps.crossings;
  r.smallest_gap = gaps.smallest;
  r.wall_gap = least_wall_gap(c, models, cells);
  if (r.wall_gap <= 0) throw Error("a cell passes through a wall");
  if (const long n = swallowed(c, models, cells); n > 0)
    throw Error(std::to_string(n) + " cells lie inside others");
  return r;
}

/// The number of cells a hematocrit is rounded to may exceed it by half a cell.
void refuse_hopeless(const Case& c, const std::vector<CellModel>& models, const Asked& asked) {
  double largest = 0;
  for (const CellModel& m : models) largest = std::max(largest, m.volume);
  if (asked.hematocrit <= largest_hematocrit + 0.5 * largest / fluid_volume(c)) return;
  char text[96];
  std::snprintf(text, sizeof text, "%d cells make a hematocrit of %.3g; accepted: at most %g",
                asked.cells(), asked.hematocrit, largest_hematocrit);
  throw Error(placement_key(c) + ": " + text);
}

bool are_coarser(const std::vector<CellModel>& meshes, const std::vector<CellModel>& models) {
  return !std::equal(
      meshes.begin(), meshes.end(), models.begin(),
      [](const CellModel& a, const CellModel& b) { return a.mesh.x.size() == b.mesh.x.size(); });
}

/// Loose cells driven together or grown, relaxed, and relaxed again with the case's own meshes.
/// @param stretch  of the space in which they lie, over the channel's height
PackedCells pack(const Case& c, const std::vector<CellModel>& models,
                 const std::vector<CellModel>& meshes, Cells loose, double stretch) {
  const double height = c.channel.size[2] / um;
  PackedCells packed;
  packed.first = std::move(loose);
  Packer packer(c, meshes, models, stretch * height);
  if (by_plates(c)) {
    packer.add(packed.first);
    packer.compress(height);
  } else {
    packer.start_small();
    packer.add(packed.first);
    packer.grow();
  }
  packer.relax();
  packed.cells = packer.cells();
  long steps = packer.steps();
  double force = packer.largest_force();
  if (are_coarser(meshes, models)) {
    Packer fine(c, models, models, height);
    fine.add(carry(packed.cells, meshes, models));
    fine.relax();
    packed.cells = fine.cells();
    steps += fine.steps();
    force = fine.largest_force();
  }
  packed.report = check_cells(c, models, packed.cells);
  packed.report.steps = steps;
  packed.report.largest_force = force;
  return packed;
}

void refuse_squeezed(const PackingReport& r) {
  if (r.area_change <= largest_change && r.volume_change <= largest_change) return;
  throw Error("cells are left squeezed, by up to " + percent(r.area_change) +
              " of their area and " + percent(r.volume_change) + " of their volume");
}

}  // namespace

PackingReport check_packed(const Case& c, const std::vector<CellModel>& models,
                           const Cells& cells) {
  try {
    PackingReport r = check_cells(c, models, cells);
    r.method = "file";
    return r;
  } catch (const Error& e) {
    throw Error(placement_key(c) + ": " + c.cells[0].packed + ": " + e.what() +
                "; accepted: a state that hemomag pack wrote");
  }
}

PackedCells pack_cells(const Case& c, const std::vector<CellModel>& models) {
  const auto start = std::chrono::steady_clock::now();
  const Asked asked = asked_of(c, models);
  refuse_hopeless(c, models, asked);
  const auto meshes = cell_models(coarser(c));
  const double stretch =
      by_plates(c) ? std::max(least_stretch, asked.hematocrit / loose_hematocrit) : 1;
  Cells loose = scatter(c, meshes, asked.counts, stretch);
  PackedCells packed;
  try {
    if (asked.cells() > 0)
      packed = pack(c, models, meshes, std::move(loose), stretch);
    else
      packed.report = check_cells(c, models, {});
    refuse_squeezed(packed.report);
  } catch (const Error& e) {
    throw Error(placement_key(c) + ": packing " + std::to_string(asked.cells()) +
                " cells, a hematocrit of " + percent(asked.hematocrit) + ", failed: " + e.what() +
                "; accepted: fewer cells, or another seed");
  }
  packed.report.method = by_plates(c) ? "compress" : "grow";
  packed.report.seconds = seconds_since(start);
  return packed;
}

}  // namespace hemomag::case_
