#include "case/placement.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <string>

#include "base/error.hpp"
#include "case/lattice_units.hpp"
#include "case/packed_file.hpp"
#include "case/packing.hpp"
#include "lattice/surface_vessel.hpp"

namespace hemomag::case_ {
namespace {

/// Distances to begin with [m]: at least these, and beyond the reach of the case's repulsions.
struct Gaps {
  double cells = 0.40e-6;  ///< between vertices of different cells
  double cell_plate = 0.3e-6, carrier_plate = 0.25e-6, carrier_cell = 0.56e-6;
  Gaps() = default;
  explicit Gaps(const Contact& contact) {
    constexpr double reach = 1.12;  // 2^(1/6): of a Lennard-Jones repulsion over its sigma
    cells = std::max(cells, reach * contact.cell_sigma.value_or(0));
    cell_plate = std::max(cell_plate, reach * contact.plate_sigma);
    carrier_plate = std::max(carrier_plate, contact.plate_sigma);
    carrier_cell = std::max(carrier_cell, contact.carrier_contact == CarrierContact::surface
                                              ? contact.surface_range
                                              : reach * contact.carrier_sigma);
  }
};

constexpr long most_tries = 1'000'000;  // of cells in all, of carriers in a row

class Random {
public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double uniform(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  /// Uniform on the unit sphere.
  Vec3 direction() {
    const double z = uniform(-1, 1), phi = uniform(0, 2 * std::numbers::pi),
                 r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

private:
  std::mt19937_64 bits_;
};

/// Distances in the channel: periodic along x and y, along z too without plates.
class Box {
public:
  explicit Box(const Case& c)
      : size(c.channel.size), periodic{true, true, c.channel.boundary != Boundary::plates},
        case_(c) {}
  Vec3 nearest(Vec3 d) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (periodic[a]) d[a] -= size[a] * std::round(d[a] / size[a]);
    return d;
  }
  /// Whether a point is in the fluid, at least `gap` from every wall.
  bool off_walls(const Vec3& x, double gap) const {
    if (in_vessel(case_)) return wall_distance(case_, x) >= gap;
    return periodic[2] || (x.z >= gap && x.z <= size[2] - gap);
  }
  /// Whether an edge whose ends are in the fluid passes through a wall too thin to hold an end.
  bool crosses_wall(const Vec3& a, const Vec3& b) const {
    return in_vessel(case_) && wall_distance(case_, 0.5 * (a + b)) <= 0;
  }
  std::array<double, 3> size;
  std::array<bool, 3> periodic;

private:
  const Case& case_;
};

/// Points sorted into bins at least as wide as the distance that is asked about.
class Bins {
public:
  Bins(const Box& box, double reach) : box_(box), reach2_(reach * reach) {
    for (std::size_t d = 0; d < 3; ++d)
      n_[d] = static_cast<int>(std::clamp(box.size[d] / reach, 1.0, most));
    bins_.resize(static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]) *
                 static_cast<std::size_t>(n_[2]));
  }
  void add(const Vec3& x) { bins_[bin(index(x, 0), index(x, 1), index(x, 2))].push_back(x); }
  bool any_near(const Vec3& x) const {
    const int i = index(x, 0), j = index(x, 1), k = index(x, 2);
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b)
        for (int c = -1; c <= 1; ++c)
          for (const Vec3& y : bins_[bin(i + a, j + b, k + c)])
            if (norm2(box_.nearest(x - y)) < reach2_) return true;
    return false;
  }

private:
  static constexpr double most = 160;  // along an axis: 100 MB
  int index(const Vec3& x, std::size_t d) const {
    return static_cast<int>(std::floor(x[d] / box_.size[d] * n_[d]));
  }
  std::size_t bin(int i, int j, int k) const {
    const auto wrap = [](int a, int n) { return static_cast<std::size_t>((a % n + n) % n); };
    return (wrap(k, n_[2]) * static_cast<std::size_t>(n_[1]) + wrap(j, n_[1])) *
               static_cast<std::size_t>(n_[0]) +
           wrap(i, n_[0]);
  }
  Box box_;
  double reach2_;
  std::array<int, 3> n_{};
  std::vector<std::vector<Vec3>> bins_;
};

/// Where a cell is and how it is turned: columns of the rotation.
struct Pose {
  Vec3 centre, ex, ey, ez;
  Vec3 place(const Vec3& p) const { return centre + p.x * ex + p.y * ey + p.z * ez; }
  bool inside(const CellModel& model, const Vec3& from_centre) const {
    return norm(from_centre) < model.reach &&
           model.contains({dot(from_centre, ex), dot(from_centre, ey), dot(from_centre, ez)});
  }
};

Pose random_pose(Random& random, const Box& box) {
  Pose p;
  for (std::size_t d = 0; d < 3; ++d) p.centre[d] = random.uniform(0, box.size[d]);
  p.ez = random.direction();
  do {
    p.ex = cross(random.direction(), p.ez);
  } while (norm(p.ex) < 0.1);
  p.ex = p.ex / norm(p.ex);
  p.ey = cross(p.ez, p.ex);
  return p;
}

std::string cell_key(const Case& c, std::size_t model) {
  return position(c, entry_path("cell", model, c.cells.size()) + ".placement");
}

/// A cell of any shape: the middle of the box around it, and the surface about that, in um.
class ShapedCell {
public:
  ShapedCell(const CellModel& model, const std::vector<Vec3>& x) {
    Vec3 low = x[0], high = x[0];
    for (const Vec3& p : x)
      for (std::size_t d = 0; d < 3; ++d)
        low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
    middle_ = 0.5 * (low + high);
    reach_ = 0.5 * norm(high - low);
    lattice::Surface s{{}, model.mesh.triangles};
    for (const Vec3& p : x) s.points.push_back(unit * (p - middle_));
    surface_ = std::make_unique<lattice::SurfaceVessel>(std::move(s));
  }
  bool contains(const Vec3& x, const Box& box) const {
    const Vec3 r = box.nearest(x - middle_);
    return norm(r) < reach_ && surface_->distance(unit * r) > 0;
  }

private:
  static constexpr double unit = 1e6;
  Vec3 middle_;
  double reach_ = 0;
  std::unique_ptr<lattice::SurfaceVessel> surface_;
};

/// Everything placed so far. Models are referred to, not copied.
class Packing {
public:
  Packing(const Case& c, const Gaps& apart)
      : gaps(apart), box_(c), vertices_(box_, gaps.cells), carriers_near_(box_, gaps.carrier_cell) {
  }
  const Gaps gaps;

  bool fits(const CellModel& model, const Pose& pose) const {
    for (const Vec3& p : model.mesh.x) {
      const Vec3 x = pose.place(p);
      if (!box_.off_walls(x, gaps.cell_plate) || vertices_.any_near(x)) return false;
      if (inside_any(x)) return false;
    }
    for (const auto& e : model.topology.edges)
      if (box_.crosses_wall(pose.place(model.mesh.x[static_cast<std::size_t>(e.a)]),
                            pose.place(model.mesh.x[static_cast<std::size_t>(e.b)])))
        return false;
    for (const Placed& other : placed_) {
      const double apart = norm(box_.nearest(other.pose.centre - pose.centre));
      if (apart > other.model->reach + model.reach) continue;
      for (const Vec3& x : other.x)
        if (pose.inside(model, box_.nearest(x - pose.centre))) return false;
    }
    return true;
  }

  std::vector<Vec3> add(const CellModel& model, const Pose& pose) {
    std::vector<Vec3> x;
    for (const Vec3& p : model.mesh.x) x.push_back(pose.place(p));
    for (const Vec3& p : x) vertices_.add(p), carriers_near_.add(p);
    placed_.push_back({&model, pose, x});
    return x;
  }

  /// A cell that no longer has the shape of its model.
  void add_shaped(const CellModel& model, const std::vector<Vec3>& x) {
    for (const Vec3& p : x) carriers_near_.add(p);
    shaped_.emplace_back(model, x);
  }

  bool carrier_fits(const Vec3& x) const {
    return box_.off_walls(x, gaps.carrier_plate) && !carriers_near_.any_near(x) && !inside_any(x);
  }

  const Box& box() const { return box_; }

private:
  struct Placed {
    const CellModel* model;
    Pose pose;
    std::vector<Vec3> x;
  };
  bool inside_any(const Vec3& x) const {
    return std::any_of(placed_.begin(), placed_.end(),
                       [&](const Placed& p) {
                         return p.pose.inside(*p.model, box_.nearest(x - p.pose.centre));
                       }) ||
           std::any_of(shaped_.begin(), shaped_.end(),
                       [&](const ShapedCell& cell) { return cell.contains(x, box_); });
  }
  Box box_;
  Bins vertices_, carriers_near_;
  std::vector<Placed> placed_;
  std::vector<ShapedCell> shaped_;
};

void place_at_random(System& system, Packing& packing, const Case& c, std::size_t model, int count,
                     Random& random) {
  long tries = 0;
  for (int placed = 0; placed < count; ++tries) {
    if (tries >= most_tries)
      throw Error(cell_key(c, model) + ": random placement put " + std::to_string(placed) + " of " +
                  std::to_string(count) + " cells after " + std::to_string(tries) +
                  " tries; accepted: fewer cells, or " +
                  (is_packed(c) ? "a larger channel"
                                : "a packed state (placement \"compress\" or \"grow\")"));
    const Pose pose = random_pose(random, packing.box());
    if (!packing.fits(system.models[model], pose)) continue;
    system.cells.push_back({model, packing.add(system.models[model], pose)});
    ++placed;
  }
}

/// Cells flat in layers, as close as their gap allows. In a vessel only the places of the grid that
/// fit into it are taken.
void place_on_grid(System& system, Packing& packing, const Case& c, std::size_t model, int count) {
  const auto& x = system.models[model].mesh.x;
  double rim = 0, top = 0;
  for (const Vec3& p : x)
    rim = std::max(rim, std::hypot(p.x, p.y)), top = std::max(top, std::fabs(p.z));
  const auto& box = packing.box();
  const double side = 2 * rim + 1.05 * packing.gaps.cells,
               height = 2 * top + 1.05 * packing.gaps.cells;
  const double margin = box.periodic[2] ? 0 : packing.gaps.cell_plate - packing.gaps.cells / 2;
  const int nx = static_cast<int>(box.size[0] / side), ny = static_cast<int>(box.size[1] / side),
            nz = static_cast<int>((box.size[2] - 2 * margin) / height);
  const auto no_room = [&](long room) {
    return Error(
        cell_key(c, model) + ": a grid has room for " + std::to_string(room) + " of " +
        std::to_string(count) +
        " cells; accepted: fewer cells, or a packed state (placement \"compress\" or \"grow\")");
  };
  const long places = static_cast<long>(nx) * ny * nz;
  if (places < count) throw no_room(places);
  int placed = 0;
  for (int n = 0; n < places && placed < count; ++n) {
    const int i = n % nx, j = n / nx % ny, k = n / (nx * ny);
    const Pose pose{{(i + 0.5) * box.size[0] / nx, (j + 0.5) * box.size[1] / ny,
                     margin + (k + 0.5) * (box.size[2] - 2 * margin) / nz},
                    {1, 0, 0},
                    {0, 1, 0},
                    {0, 0, 1}};
    if (!packing.fits(system.models[model], pose)) {
      if (in_vessel(c)) continue;
      throw Error(cell_key(c, model) +
                  ": the grid overlaps cells of another entry; accepted: random placement of one");
    }
    system.cells.push_back({model, packing.add(system.models[model], pose)});
    ++placed;
  }
  if (placed < count) throw no_room(placed);
}

void place_carriers(System& system, const Packing& packing, const Case& c, std::size_t entry,
                    Random& random) {
  const Carrier& carrier = c.carriers[entry];
  const Box& box = packing.box();
  const bool worm = carrier.kind == CarrierKind::worm;
  const int beads = worm ? carrier.beads : 1;
  Bins others(box, 2 * carrier.radius);
  long failures = 0;  // in a row
  for (int placed = 0; placed < carrier.count;) {
    if (failures >= most_tries)
      throw Error(position(c, entry_path("carrier", entry, c.carriers.size()) + ".count") + ": " +
                  std::to_string(placed) + " of " + std::to_string(carrier.count) +
                  " carriers found a place outside the cells; accepted: fewer");
    Vec3 x;
    for (std::size_t d = 0; d < 3; ++d) {
      const double gap = d == 2 && !box.periodic[2] ? packing.gaps.carrier_plate : 0;
      x[d] = random.uniform(gap, box.size[d] - gap);
    }
    const Vec3 step = worm ? 2 * carrier.radius * random.direction() : Vec3{};
    std::vector<Vec3> chain;
    chain.reserve(static_cast<std::size_t>(beads));
    for (int b = 0; b < beads; ++b) chain.push_back(x + static_cast<double>(b) * step);
    const bool fits = std::all_of(chain.begin(), chain.end(), [&](const Vec3& p) {
      return packing.carrier_fits(p) && !(c.magnetic.dipoles && others.any_near(p));
    });
    if (!fits) {
      ++failures;
      continue;
    }
    failures = 0;
    for (const Vec3& p : chain) others.add(p);
    system.carriers.push_back({entry, std::move(chain)});
    ++placed;
  }
}

/// The largest cells come first: the small ones still fit between them.
std::vector<std::size_t> largest_first(const std::vector<CellModel>& models) {
  std::vector<std::size_t> order(models.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return models[a].volume > models[b].volume;
  });
  return order;
}

/// Regular entries first: the random ones find their places around them.
void place_loosely(System& system, Packing& packing, const Case& c, Random& random) {
  for (const Placement how : {Placement::grid, Placement::random})
    for (const std::size_t m : largest_first(system.models)) {
      if (c.cells[m].placement != how) continue;
      const int count = cell_count(c, c.cells[m], system.models[m]);
      if (how == Placement::grid)
        place_on_grid(system, packing, c, m, count);
      else
        place_at_random(system, packing, c, m, count, random);
    }
}

}  // namespace

int cell_count(const Case& c, const Cell& cell, const CellModel& model) {
  if (cell.count) return *cell.count;
  return static_cast<int>(
      std::lround(cell.hematocrit.value_or(0) * fluid_volume(c) / model.volume));
}

std::vector<System::PlacedCell> scatter_cells(const Case& c, const std::vector<CellModel>& models,
                                              const std::vector<int>& counts) {
  System system{models, {}, {}, {}};
  Packing packing(c, Gaps());  // packing itself drives them apart
  Random random(c.seed);
  for (const std::size_t m : largest_first(models))
    place_at_random(system, packing, c, m, counts[m], random);
  return std::move(system.cells);
}

System place(const Case& c) {
  System system;
  system.models = cell_models(c);
  Packing packing(c, Gaps(c.contact));
  Random random(c.seed);
  if (is_packed(c)) {
    if (c.cells[0].placement == Placement::file) {
      system.cells = read_packed(c, system.models);
      system.packing = check_packed(c, system.models, system.cells);
    } else {
      PackedCells packed = pack_cells(c, system.models);
      system.cells = std::move(packed.cells);
      system.packing = packed.report;
    }
    for (const auto& cell : system.cells) packing.add_shaped(system.models[cell.model], cell.x);
  } else {
    place_loosely(system, packing, c, random);
  }
  for (std::size_t entry = 0; entry < c.carriers.size(); ++entry)
    place_carriers(system, packing, c, entry, random);
  return system;
}

}  // namespace hemomag::case_
