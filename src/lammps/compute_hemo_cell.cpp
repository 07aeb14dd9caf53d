#include "lammps/compute_hemo_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "update.h"

#include "base/error.hpp"

using namespace LAMMPS_NS;
namespace analysis = hemomag::analysis;
using hemomag::Vec3;

// The array is global, so every rank learns every row in any case. The sums are therefore plain
// collectives over the rows, which costs what gathering the rows would and happens at output only.

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr int image_wrap = 2 * IMGMAX;  // image flags are known up to this

/// Image flag of dimension d, in [-IMGMAX, IMGMAX).
int flag(imageint image, int d) {
  const int shift = d == 0 ? 0 : d == 1 ? IMGBITS : IMG2BITS;
  return static_cast<int>((image >> shift) & IMGMASK) - IMGMAX;
}

int wrapped(int images) {
  return ((images + IMGMAX) % image_wrap + image_wrap) % image_wrap - IMGMAX;
}

/// Distance from the line through the centre along x, the axis of the flow's rotation.
double from_vorticity_axis(const Vec3& x, const Vec3& centre) {
  return std::hypot(x.y - centre.y, x.z - centre.z);
}

}  // namespace

ComputeHemoCell::ComputeHemoCell(LAMMPS* lmp, int narg, char** arg) : Compute(lmp, narg, arg) {
  if (narg != 3) error->all(FLERR, std::string("compute hemo/cell takes no arguments"));
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & groupbit) && atom->molecule[i] > 0) ids_.push_back(atom->molecule[i]);
  const auto unique = [&] {
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  };
  unique();
  const int n = static_cast<int>(ids_.size());
  std::vector<int> counts(static_cast<std::size_t>(comm->nprocs)), starts(counts.size(), 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<tagint> all(static_cast<std::size_t>(starts.back() + counts.back()));
  MPI_Allgatherv(ids_.data(), n, MPI_LMP_TAGINT, all.data(), counts.data(), starts.data(),
                 MPI_LMP_TAGINT, world);
  ids_ = std::move(all);
  unique();
  if (ids_.empty())
    error->all(FLERR, std::string("compute hemo/cell: the group has no atom with a molecule id"));

  array_flag = 1;
  size_array_rows = static_cast<int>(ids_.size());
  size_array_cols = columns;
  extarray = 0;
  memory->create(array, size_array_rows, size_array_cols, "hemo/cell:array");
  cells_.resize(ids_.size());
  followed_.resize(ids_.size());
}

ComputeHemoCell::~ComputeHemoCell() { memory->destroy(array); }

void ComputeHemoCell::init() {
  membrane_ = dynamic_cast<AngleHemoMembrane*>(force->angle_match("hemo/membrane"));
  if (!membrane_)
    error->all(FLERR, std::string("compute hemo/cell needs angle_style hemo/membrane"));
}

std::optional<std::size_t> ComputeHemoCell::row_of(tagint id) const {
  const auto at = std::lower_bound(ids_.begin(), ids_.end(), id);
  if (at == ids_.end() || *at != id) return std::nullopt;
  return static_cast<std::size_t>(at - ids_.begin());
}

/// The row of each triangle of the surface; one past the last for cells outside the group.
std::vector<std::size_t> ComputeHemoCell::rows_of(const Surface& surface) const {
  std::vector<std::size_t> rows;
  for (const tagint id : surface.molecule) rows.push_back(row_of(id).value_or(ids_.size()));
  return rows;
}

/// A point near each cell, the same on every rank, and the mean velocity of its vertices.
void ComputeHemoCell::find_references(const Surface& surface, const std::vector<std::size_t>& row) {
  struct Sums {
    Vec3 centroids, velocity;
    double triangles = 0, vertices = 0;
  };
  constexpr std::size_t width = sizeof(Sums) / sizeof(double);
  std::vector<Sums> sums(ids_.size());
  for (std::size_t t = 0; t < row.size(); ++t) {
    if (row[t] == ids_.size()) continue;
    const auto& [a, b, c] = surface.triangles[t].x;
    sums[row[t]].centroids += (a + b + c) / 3;
    sums[row[t]].triangles += 1;
  }
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const auto r = row_of(atom->molecule[i]);
    if (!r) continue;
    sums[*r].velocity += Vec3{atom->v[i][0], atom->v[i][1], atom->v[i][2]};
    sums[*r].vertices += 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(width * sums.size()), MPI_DOUBLE,
                MPI_SUM, world);
  for (std::size_t r = 0; r < sums.size(); ++r) {
    if (sums[r].triangles == 0 || sums[r].vertices == 0)
      error->all(FLERR, "compute hemo/cell: molecule " + std::to_string(ids_[r]) +
                            " of the group " +
                            "has no triangles of angle_style hemo/membrane; they are known from " +
                            "the first force computation on, and only cells belong in the group");
    cells_[r].reference = sums[r].centroids / sums[r].triangles;
    cells_[r].velocity = sums[r].velocity / sums[r].vertices;
  }
}

void ComputeHemoCell::find_shapes(const Surface& surface, const std::vector<std::size_t>& row) {
  std::vector<analysis::SolidMoments> moments(ids_.size());
  static_assert(sizeof(analysis::SolidMoments) == 11 * sizeof(double));
  for (std::size_t t = 0; t < row.size(); ++t) {
    if (row[t] == ids_.size()) continue;
    const auto& [a, b, c] = surface.triangles[t].x;
    const Vec3& o = cells_[row[t]].reference;
    moments[row[t]].add(a - o, b - o, c - o);
  }
  MPI_Allreduce(MPI_IN_PLACE, moments.data(), static_cast<int>(11 * moments.size()), MPI_DOUBLE,
                MPI_SUM, world);
  for (std::size_t r = 0; r < moments.size(); ++r) {
    if (!(moments[r].volume > 0))
      error->all(FLERR, "compute hemo/cell: molecule " + std::to_string(ids_[r]) +
                            " encloses the volume " + std::to_string(moments[r].volume) +
                            "; it must be a closed surface, not turned inside out");
    cells_[r].shape = analysis::cell_shape(moments[r]);
  }
}

/// Mark in each cell the vertex farthest from its vorticity axis: of all vertices its angle in the
/// shear plane is the best defined, and it stays so, since it circles that axis. Symmetric meshes
/// have several; round-off must not choose between them.
void ComputeHemoCell::choose_markers(const Surface& surface, const std::vector<std::size_t>& row) {
  constexpr double equal = 1 - 1e-6;
  const auto distance = [&](std::size_t t, std::size_t k) {
    const Cell& cell = cells_[row[t]];
    return from_vorticity_axis(surface.triangles[t].x[k] - cell.reference, cell.shape.centre);
  };
  std::vector<double> farthest(ids_.size(), 0.0);
  for (std::size_t t = 0; t < row.size(); ++t)
    for (std::size_t k = 0; row[t] < ids_.size() && k < 3; ++k)
      farthest[row[t]] = std::max(farthest[row[t]], distance(t, k));
  MPI_Allreduce(MPI_IN_PLACE, farthest.data(), static_cast<int>(farthest.size()), MPI_DOUBLE,
                MPI_MAX, world);
  std::vector<tagint> lowest(ids_.size(), std::numeric_limits<tagint>::max());
  for (std::size_t t = 0; t < row.size(); ++t)
    for (std::size_t k = 0; row[t] < ids_.size() && k < 3; ++k)
      if (distance(t, k) >= equal * farthest[row[t]])
        lowest[row[t]] = std::min(lowest[row[t]], static_cast<tagint>(surface.triangles[t].tag[k]));
  MPI_Allreduce(MPI_IN_PLACE, lowest.data(), static_cast<int>(lowest.size()), MPI_LMP_TAGINT,
                MPI_MIN, world);
  for (std::size_t r = 0; r < lowest.size(); ++r) followed_[r].marker = lowest[r];
}

/// Bounds and marked vertex of each cell, and the image the surface is in.
void ComputeHemoCell::find_extremes(const Surface& surface, const std::vector<std::size_t>& row) {
  struct Maxima {
    Vec3 minus_lo{-inf, -inf, -inf}, hi{-inf, -inf, -inf}, marker{-inf, -inf, -inf},
        image{-inf, -inf, -inf};
  };
  constexpr std::size_t width = sizeof(Maxima) / sizeof(double);
  std::vector<Maxima> most(ids_.size());
  const Vec3 period{domain->xprd, domain->yprd, domain->zprd};
  for (std::size_t t = 0; t < row.size(); ++t) {
    if (row[t] == ids_.size()) continue;
    auto& m = most[row[t]];
    const auto& triangle = surface.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 x = triangle.x[k] - cells_[row[t]].reference;
      for (std::size_t d = 0; d < 3; ++d) {
        m.minus_lo[d] = std::max(m.minus_lo[d], -x[d]);
        m.hi[d] = std::max(m.hi[d], x[d]);
      }
      if (triangle.tag[k] == followed_[row[t]].marker) m.marker = x;
    }
    // A triangle is held by the rank that owns its second atom.
    const int j = atom->map(static_cast<tagint>(triangle.tag[1]));
    for (int d = 0; d < 3; ++d) {
      const auto at = static_cast<std::size_t>(d);
      const auto shift = std::lround((triangle.x[1][at] - atom->x[j][d]) / period[at]);
      m.image[at] = wrapped(flag(atom->image[j], d) - static_cast<int>(shift));
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, most.data(), static_cast<int>(width * most.size()), MPI_DOUBLE,
                MPI_MAX, world);
  for (std::size_t r = 0; r < most.size(); ++r) {
    cells_[r].lo = -most[r].minus_lo;
    cells_[r].hi = most[r].hi;
    cells_[r].marker = most[r].marker;
    for (std::size_t d = 0; d < 3; ++d) cells_[r].image[d] = static_cast<int>(most[r].image[d]);
  }
}

/// Count turns of the marker and of the long axis, and boxes that the centre has crossed: what is
/// seen leaves a whole number of periods open, and the last call tells which.
void ComputeHemoCell::follow(std::size_t r) {
  using std::numbers::pi;
  const Cell& cell = cells_[r];
  Followed& last = followed_[r];
  const Vec3 arm = cell.marker - cell.shape.centre;
  const double angle = std::atan2(arm.z, arm.y);
  last.phase = started_ ? analysis::nearest_turn(angle, last.phase, 2 * pi) : angle;
  last.axis = started_ ? analysis::nearest_turn(cell.shape.inclination, last.axis, pi)
                       : cell.shape.inclination;
  const Vec3 period{domain->xprd, domain->yprd, domain->zprd};
  const Vec3 centre = cell.reference + cell.shape.centre;
  for (std::size_t d = 0; d < 3; ++d) {
    const double unwrapped = centre[d] + cell.image[d] * period[d];
    last.centre[d] = started_
                         ? analysis::nearest_turn(unwrapped, last.centre[d], image_wrap * period[d])
                         : unwrapped;
  }
}

void ComputeHemoCell::write_row(std::size_t r) {
  constexpr double degrees = 180 / std::numbers::pi;
  const Cell& cell = cells_[r];
  const auto& s = cell.shape;
  double* row = array[r];
  row[molecule] = static_cast<double>(ids_[r]);
  row[volume] = s.volume;
  row[area] = s.area;
  for (std::size_t d = 0; d < 3; ++d) {
    row[centre + d] = followed_[r].centre[d];
    row[velocity + d] = cell.velocity[d];
    row[semi_axes + d] = s.semi_axes[d];
    row[long_axis + d] = s.directions[0][d];
    row[short_axis + d] = s.directions[2][d];
    row[extent + d] = cell.hi[d] - cell.lo[d];
  }
  row[taylor] = s.taylor;
  row[taylor_in_plane] = s.taylor_in_plane;
  row[inclination] = s.inclination * degrees;
  row[phase] = followed_[r].phase * degrees;
  row[treading] = (followed_[r].phase - followed_[r].axis) * degrees;
}

void ComputeHemoCell::compute_array() {
  invoked_array = update->ntimestep;
  const Surface surface = membrane_->surface();
  const auto row = rows_of(surface);
  find_references(surface, row);
  find_shapes(surface, row);
  if (!started_) choose_markers(surface, row);
  find_extremes(surface, row);
  for (std::size_t r = 0; r < ids_.size(); ++r) {
    follow(r);
    write_row(r);
  }
  started_ = true;
}

std::vector<double> ComputeHemoCell::followed() const {
  std::vector<double> all;
  for (const Followed& f : followed_)
    all.insert(all.end(), {static_cast<double>(f.marker), f.phase, f.axis, f.centre.x, f.centre.y,
                           f.centre.z});
  return all;
}

void ComputeHemoCell::resume(const std::vector<double>& followed) {
  constexpr std::size_t width = 6;
  if (followed.size() != width * followed_.size())
    throw hemomag::Error("compute hemo/cell: the restart file has " +
                         std::to_string(followed.size() / width) + " cells, the group has " +
                         std::to_string(followed_.size()));
  for (std::size_t r = 0; r < followed_.size(); ++r) {
    const double* f = &followed[width * r];
    followed_[r] = {static_cast<tagint>(f[0]), f[1], f[2], {f[3], f[4], f[5]}};
  }
  started_ = true;
}
