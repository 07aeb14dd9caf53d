#include "solver/fluid_solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "lattice/d3q19.hpp"

namespace hemomag::solver {
namespace {

using lattice::NodeBox;
namespace d3q19 = lattice::d3q19;

constexpr int lanes = static_cast<int>(cache_line / sizeof(double));
// Populations are swept side by side in 19 streams: start each on another cache line of a page.
constexpr int stagger = 5 * lanes;

int coupling_halo(double reach_beyond_block) {
  return ibm::kernel_reach + static_cast<int>(std::ceil(reach_beyond_block));
}

}  // namespace

FluidSolver::FluidSolver(const Neighbourhood& at, const FluidParameters& parameters)
    : at_(at), parameters_(parameters), f_layout_(at.block.size, 1, lanes),
      n_layout_(at.block.size, coupling_halo(parameters.reach_beyond_block), lanes),
      f_storage_(19 * (f_layout_.count + stagger)), force_storage_(3 * n_layout_.count),
      u_storage_(3 * n_layout_.count), halo_(at_) {
  for (int d = 0; d < 3; ++d) {
    if (at.block.size[d] < n_layout_.halo)
      throw Error("fluid: a rank holds " + std::to_string(at.block.size[d]) + " nodes along " +
                  "xyz"[d] + ", but the coupling needs at least " + std::to_string(n_layout_.halo) +
                  " (use fewer ranks or a smaller skin)");
    force_[d] =
        force_storage_.data() + static_cast<std::size_t>(d) * n_layout_.count + n_layout_.origin;
    u_[d] = u_storage_.data() + static_cast<std::size_t>(d) * n_layout_.count + n_layout_.origin;
  }
  for (std::size_t i = 0; i < 19; ++i)
    f_[i] = f_storage_.data() + i * (f_layout_.count + stagger) + f_layout_.origin;
  wraps_x_ = at_.neighbour[0][0] == at_.rank && at_.neighbour[0][1] == at_.rank;
  if (const int axis = parameters.plate_axis; axis >= 0)
    for (int side = 0; side < 2; ++side)
      if (at_.neighbour[axis][side] == MPI_PROC_NULL)
        plates_.push_back({axis, side == 0 ? fluid::Side::low : fluid::Side::high,
                           parameters.plate_velocity[static_cast<std::size_t>(side)]});
}

void FluidSolver::set_node(int x, int y, int z, const std::array<double, 19>& g) {
  for (std::size_t i = 0; i < 19; ++i) f_[i][f_layout_.index(x, y, z)] = g[i];
}

void FluidSolver::finish_initialise() {
  next_ = fluid::Pass::local;
  exchange_velocity(0);
}

void FluidSolver::clear_forces() {
  if (!forces_clear_) std::fill_n(force_storage_.data(), force_storage_.size(), 0.0);
  forces_clear_ = true;
  plate_share_ = {};
}

std::ptrdiff_t FluidSolver::spread(std::span<const Vec3> x, const ibm::Selection& selection,
                                   std::span<const Vec3> f) {
  forces_clear_ = false;
  const ibm::NodeVectorView<double> nodes{
      force_,
      n_layout_,
      {double(block().begin[0]), double(block().begin[1]), double(block().begin[2])}};
  return ibm::spread(parameters_.kernel, nodes, x, selection, f, simd_);
}

std::ptrdiff_t FluidSolver::interpolate(std::span<const Vec3> x, const ibm::Selection& selection,
                                        std::span<Vec3> u) const {
  const ibm::NodeVectorView<const double> nodes{
      {u_[0], u_[1], u_[2]},
      n_layout_,
      {double(block().begin[0]), double(block().begin[1]), double(block().begin[2])}};
  return ibm::interpolate(parameters_.kernel, nodes, x, selection, u, simd_);
}

/// The block, with `halo` ghost layers along the first `axes_done` axes.
NodeBox FluidSolver::with_halo(int axes_done, int halo) const {
  NodeBox box{{0, 0, 0}, block().size};
  for (int d = 0; d < axes_done; ++d) {
    box.lo[d] -= halo;
    box.hi[d] += halo;
  }
  return box;
}

/// The slabs at both ends of an axis: ghosts, and the owned nodes next to them; along lower axes
/// the halo is included.
FluidSolver::Faces FluidSolver::faces(int axis, int width) const {
  const NodeBox face = with_halo(axis, width);
  const int n = block().size[axis];
  Faces f{face, face, face, face, face};
  f.ghost_low.lo[axis] = -width, f.ghost_low.hi[axis] = 0;
  f.first.hi[axis] = width;
  f.last.lo[axis] = n - width;
  f.ghost_high.lo[axis] = n, f.ghost_high.hi[axis] = n + width;
  return f;
}

/// Halo forces go home: z, then y, then x, so that edges and corners travel with the faces.
void FluidSolver::reduce_forces() {
  if (forces_clear_) return;
  for (int axis = 2; axis >= 0; --axis) {
    const Faces at = faces(axis, n_layout_.halo);
    for (const auto& plate : plates_)
      if (plate.axis == axis)
        plate_share_ += fluid::fold_mirror_force(plate, force_, n_layout_, at.whole);
    halo_.exchange(axis, n_layout_, {force_, at.ghost_low}, {force_, at.last},
                   {force_, at.ghost_high}, {force_, at.first}, Combine::add);
  }
}

void FluidSolver::exchange_velocity(int first_axis) {
  for (int axis = first_axis; axis < 3; ++axis) {
    const Faces at = faces(axis, n_layout_.halo);
    halo_.exchange(axis, n_layout_, {u_, at.first}, {u_, at.ghost_high}, {u_, at.last},
                   {u_, at.ghost_low}, Combine::copy);
    for (const auto& plate : plates_)
      if (plate.axis == axis) fluid::fill_mirror_velocity(plate, u_, n_layout_, at.whole);
  }
}

/// The populations that cross a face normal to the axis in one sense.
std::array<double*, 5> FluidSolver::crossing(int axis, int sense) const {
  std::array<double*, 5> crossing{};
  const auto directions = d3q19::crossing(axis, sense);
  for (std::size_t k = 0; k < 5; ++k) crossing[k] = f_[static_cast<std::size_t>(directions[k])];
  return crossing;
}

/// Before a shift pass: ghosts take the neighbours' populations that will enter, x, then y, then z.
void FluidSolver::send_populations_forward() {
  for (int axis = wraps_x_ ? 1 : 0; axis < 3; ++axis) {
    const auto up = crossing(axis, 1), down = crossing(axis, -1);
    const Faces at = faces(axis, 1);
    // A local pass left f_i* in slot opposite(i): what goes up lies in the slots that point down.
    halo_.exchange(axis, f_layout_, {up, at.first}, {up, at.ghost_high}, {down, at.last},
                   {down, at.ghost_low}, Combine::copy);
  }
  // After the exchanges, which also pass over edges that belong to the plate.
  for (const auto& plate : plates_)
    plate_momentum_[plate.side == fluid::Side::high] =
        fluid::bounce_before_shift(plate, f_, f_layout_);
}

/// After a shift pass: what was written to ghosts goes home, z, then y, then x.
void FluidSolver::send_populations_home() {
  for (int axis = 2; axis >= (wraps_x_ ? 1 : 0); --axis) {
    const auto up = crossing(axis, 1), down = crossing(axis, -1);
    const Faces at = faces(axis, 1);
    halo_.exchange(axis, f_layout_, {down, at.ghost_low}, {down, at.last}, {up, at.ghost_high},
                   {up, at.first}, Combine::copy);
  }
  if (wraps_x_) wrap_edges_home();
  for (const auto& plate : plates_)
    plate_momentum_[plate.side == fluid::Side::high] =
        fluid::bounce_after_shift(plate, f_, f_layout_);
}

/// Rows that got populations from neighbours along y and z pass on those that cross x as well.
void FluidSolver::wrap_edges_home() {
  const int n = block().size[0];
  const auto up = crossing(0, 1), down = crossing(0, -1);
  const auto wrap_rows = [&](const NodeBox& box) {
    for_each_row(box, f_layout_, [&](std::ptrdiff_t row, int) {
      for (std::size_t k = 0; k < 5; ++k) {
        up[k][row] = up[k][row + n];
        down[k][row + n - 1] = down[k][row - 1];
      }
    });
  };
  for (const int axis : {1, 2}) {
    NodeBox edge = with_halo(0, 0);
    edge.hi[axis] = 1;
    wrap_rows(edge);
    edge.lo[axis] = block().size[axis] - 1;
    edge.hi[axis] = block().size[axis];
    wrap_rows(edge);
  }
}

fluid::SweepFields FluidSolver::sweep_fields() {
  fluid::SweepFields s{};
  std::copy(f_.begin(), f_.end(), s.f);
  std::copy(force_.begin(), force_.end(), s.force);
  std::copy(u_.begin(), u_.end(), s.u);
  s.f_row = f_layout_.row, s.f_plane = f_layout_.plane;
  s.n_row = n_layout_.row, s.n_plane = n_layout_.plane;
  s.padded_x = f_layout_.padded_x;
  s.wrap_x = wraps_x_ ? block().size[0] : 0;
  s.n_halo = n_layout_.halo;
  s.y_hi = block().size[1];
  s.z_hi = block().size[2];
  return s;
}

void FluidSolver::step() {
  reduce_forces();
  if (next_ == fluid::Pass::shift) send_populations_forward();
  fluid::sweep_trt(next_, sweep_fields(), parameters_.relaxation, simd_);
  if (next_ == fluid::Pass::shift) send_populations_home();
  next_ = next_ == fluid::Pass::local ? fluid::Pass::shift : fluid::Pass::local;
  exchange_velocity(wraps_x_ ? 1 : 0);
}

/// Visit the 19 populations of every owned node as they will be collided next: visit(node in
/// x-fastest order, g).
template <class Visit> void FluidSolver::for_each_population(Visit visit) {
  const bool shifted = next_ == fluid::Pass::shift;
  if (shifted) {
    const auto booked = plate_momentum_;
    send_populations_forward();  // only fills ghosts: the next step may do it again
    plate_momentum_ = booked;
  }
  std::size_t node = 0;
  for (int z = 0; z < block().size[2]; ++z)
    for (int y = 0; y < block().size[1]; ++y)
      for (int x = 0; x < block().size[0]; ++x) {
        std::array<double, 19> g;
        for (int i = 0; i < 19; ++i) {
          const auto& c = d3q19::e[static_cast<std::size_t>(i)];
          g[i] = shifted ? f_[d3q19::opposite[i]][f_layout_.index(x - c[0], y - c[1], z - c[2])]
                         : f_[i][f_layout_.index(x, y, z)];
        }
        visit(node++, g);
      }
}

void FluidSolver::copy_owned(std::span<double> rho, std::span<Vec3> u) {
  for_each_population([&](std::size_t node, const std::array<double, 19>& g) {
    double drho = 0;
    for (const double g_i : g) drho += g_i;
    rho[node] = 1 + drho;
  });
  std::size_t node = 0;
  for_each_row(with_halo(0, 0), n_layout_, [&](std::ptrdiff_t row, int n) {
    for (int x = 0; x < n; ++x) u[node++] = {u_[0][row + x], u_[1][row + x], u_[2][row + x]};
  });
}

double FluidSolver::max_speed() const {
  double largest = 0;
  for_each_row(with_halo(0, 0), n_layout_, [&](std::ptrdiff_t row, int n) {
    for (int x = 0; x < n; ++x) {
      const double u2 = u_[0][row + x] * u_[0][row + x] + u_[1][row + x] * u_[1][row + x] +
                        u_[2][row + x] * u_[2][row + x];
      largest = u2 <= largest ? largest : u2;  // a NaN wins
    }
  });
  return std::sqrt(largest);
}

Vec3 FluidSolver::node_force() const {
  Vec3 sum;
  for (int d = 0; d < 3; ++d)
    for_each_row(with_halo(0, 0), n_layout_, [&](std::ptrdiff_t row, int n) {
      for (int x = 0; x < n; ++x) sum[static_cast<std::size_t>(d)] += force_[d][row + x];
    });
  return sum;
}

double FluidSolver::excess_mass() {
  double mass = 0;
  for_each_population([&](std::size_t, const std::array<double, 19>& g) {
    for (const double g_i : g) mass += g_i;
  });
  return mass;
}

Vec3 FluidSolver::momentum() {
  Vec3 j;
  for_each_population([&](std::size_t, const std::array<double, 19>& g) {
    for (int i = 0; i < 19; ++i)
      j += g[i] * Vec3{double(d3q19::e[i][0]), double(d3q19::e[i][1]), double(d3q19::e[i][2])};
  });
  return j;
}

}  // namespace hemomag::solver
