#include "solver/lattice_fluid.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "fluid/exponential.hpp"
#include "lattice/d3q19.hpp"

namespace hemomag::solver {
namespace {

namespace d3q19 = lattice::d3q19;

template <class Real> constexpr int lanes = static_cast<int>(cache_line / sizeof(Real));
// Populations are swept side by side in 19 streams: start each on another cache line of a page.
template <class Real> constexpr int stagger = 5 * lanes<Real>;

/// Numbers a scheme keeps of a node.
std::size_t numbers_of(const fluid::Relaxation& relaxation) {
  return relaxation.collision == fluid::Collision::exponential ? 19 + 2 * fluid::sources : 19;
}

/// Pointers to node (0, 0, 0) of the fields that lie one after the other in a storage.
template <std::size_t n, class Real>
std::array<Real*, n> fields_in(AlignedArray<Real>& storage, const lattice::NodeLayout& layout,
                               std::ptrdiff_t apart, std::ptrdiff_t first = 0) {
  std::array<Real*, n> at{};
  for (std::size_t k = 0; k < n; ++k)
    at[k] = storage.data() + (first + static_cast<std::ptrdiff_t>(k)) * apart + layout.origin;
  return at;
}

}  // namespace

int coupling_halo(double reach_beyond_block) {
  return ibm::kernel_reach + static_cast<int>(std::ceil(reach_beyond_block));
}

template <class Real>
LatticeFluid<Real>::LatticeFluid(const Neighbourhood& at, const FluidParameters& parameters)
    : FluidSolver(at, parameters), f_layout_(at.block.size, 1, lanes<Real>),
      n_layout_(at.block.size, coupling_halo(parameters.reach_beyond_block), lanes<Real>),
      f_storage_(numbers_of(parameters.relaxation) * (f_layout_.count + stagger<Real>)),
      force_storage_(3 * n_layout_.count), u_storage_(3 * n_layout_.count), halo_(at_) {
  for (int d = 0; d < 3; ++d)
    if (at.block.size[d] < n_layout_.halo)
      throw Error("fluid: a rank holds " + std::to_string(at.block.size[d]) + " nodes along " +
                  "xyz"[d] + ", but the coupling needs at least " + std::to_string(n_layout_.halo) +
                  " (use fewer ranks or a smaller skin)");
  force_ = fields_in<3>(force_storage_, n_layout_, static_cast<std::ptrdiff_t>(n_layout_.count));
  u_ = fields_in<3>(u_storage_, n_layout_, static_cast<std::ptrdiff_t>(n_layout_.count));
  const auto apart = static_cast<std::ptrdiff_t>(f_layout_.count) + stagger<Real>;
  f_ = fields_in<19>(f_storage_, f_layout_, apart);
  if (exponential()) {
    last_ = fields_in<fluid::sources>(f_storage_, f_layout_, apart, 19);
    present_ = fields_in<fluid::sources>(f_storage_, f_layout_, apart, 19 + fluid::sources);
  }
  wraps_x_ = at_.neighbour[0][0] == at_.rank && at_.neighbour[0][1] == at_.rank;
  make_walls();
}

template <class Real> void LatticeFluid<Real>::make_walls() {
  if (const int axis = parameters_.plate_axis; axis >= 0)
    for (int side = 0; side < 2; ++side)
      if (at_.neighbour[axis][side] == MPI_PROC_NULL)
        plates_.push_back({axis, side == 0 ? fluid::Side::low : fluid::Side::high,
                           parameters_.plate_velocity[static_cast<std::size_t>(side)]});
  if (!has_vessel()) return;
  if (parameters_.plate_axis >= 0)
    throw Error("fluid: plates and a vessel exclude each other; a vessel's box is periodic");
  distance_storage_ = AlignedArray<Real>(n_layout_.count);
  distance_ = distance_storage_.data() + n_layout_.origin;
  const auto& global = block().global;
  const auto wrapped = [&](int i, int d) {
    const int n = global[d];
    return ((block().begin[d] + i) % n + n) % n + 0.5;
  };
  const int h = n_layout_.halo;
  for (int z = -h; z < block().size[2] + h; ++z)
    for (int y = -h; y < block().size[1] + h; ++y)
      for (int x = -h; x < block().size[0] + h; ++x)
        distance_[n_layout_.index(x, y, z)] = static_cast<Real>(
            parameters_.vessel->distance({wrapped(x, 0), wrapped(y, 1), wrapped(z, 2)}));
  // The exponential scheme's distribution is reflected as a whole: half-way only.
  const auto rule = exponential() ? fluid::WallRule::halfway : parameters_.wall_rule;
  links_ = fluid::WallLinks<Real>(
      f_layout_, rule, [&](int x, int y, int z) { return wet(n_layout_.index(x, y, z)); },
      [&](int x, int y, int z, int i) { return fraction_in_fluid(x, y, z, i); });
  ghosts_ = fluid::WallGhosts<Real>(n_layout_, distance_);
}

/// Where along the link from a fluid node the distance from the wall vanishes, by bisection; half
/// way if it does not (the two ends of a periodic vessel that do not match).
template <class Real>
double LatticeFluid<Real>::fraction_in_fluid(int x, int y, int z, int direction) const {
  const auto& c = d3q19::e[static_cast<std::size_t>(direction)];
  const Vec3 from{block().begin[0] + x + 0.5, block().begin[1] + y + 0.5,
                  block().begin[2] + z + 0.5};
  const Vec3 link{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
  const auto in_fluid = [&](double q) { return parameters_.vessel->distance(from + q * link) > 0; };
  if (!in_fluid(0) || in_fluid(1)) return 0.5;
  double low = 0, high = 1;
  constexpr int halvings = 52;  // to the last bit
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (in_fluid(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

template <class Real>
void LatticeFluid<Real>::initialise(const std::function<Flow(const Vec3&)>& field) {
  for (int z = 0; z < block().size[2]; ++z)
    for (int y = 0; y < block().size[1]; ++y)
      for (int x = 0; x < block().size[0]; ++x) {
        const std::ptrdiff_t node = n_layout_.index(x, y, z), at = f_layout_.index(x, y, z);
        Flow flow;
        if (wet(node))
          flow = field(
              {block().begin[0] + x + 0.5, block().begin[1] + y + 0.5, block().begin[2] + z + 0.5});
        const auto& [u, grad_u] = flow;
        const auto g = fluid::populations(1.0, u, grad_u, parameters_.relaxation.tau);
        for (std::size_t i = 0; i < 19; ++i) f_[i][at] = static_cast<Real>(g[i]);
        for (std::size_t d = 0; d < 3; ++d) {
          u_[d][node] = static_cast<Real>(u[d]);
        }
        if (!exponential()) continue;
        const Real velocity[3] = {u_[0][node], u_[1][node], u_[2][node]}, none[3] = {};
        const auto numbers = fluid::source(Real(0), velocity, none, Real(1));
        for (std::size_t k = 0; k < fluid::sources; ++k)
          last_[k][at] = present_[k][at] = numbers.value[k];
      }
  next_ = fluid::Pass::local;
  if (exponential()) start_exponential();
  exchange_velocity(0);
}

/// The sweep adds to each population what it takes from the moments of two earlier steps; the flow
/// is taken to have been steady until now.
template <class Real> void LatticeFluid<Real>::start_exponential() {
  exchange_sources(0);
  const fluid::ExponentialRates rates(parameters_.relaxation.tau);
  for_each_row(with_halo(0, 0), f_layout_, [&](std::ptrdiff_t row, int n) {
    for (std::ptrdiff_t at = row; at < row + n; ++at)
      for (int i = 0; i < 19; ++i) {
        const auto& c = d3q19::e[static_cast<std::size_t>(i)];
        const std::ptrdiff_t ahead = at + f_layout_.index(c[0], c[1], c[2]);
        f_[static_cast<std::size_t>(i)][at] -=
            static_cast<Real>(rates.D - 2 * rates.K) * fluid::source_population(last_, at, i) +
            static_cast<Real>(rates.K) * fluid::source_population(last_, ahead, i);
      }
  });
  reflect_source(-1);
}

template <class Real> void LatticeFluid<Real>::clear_forces() {
  if (!forces_clear_) std::fill_n(force_storage_.data(), force_storage_.size(), Real(0));
  forces_clear_ = true;
  wall_shares_ = {};
}

template <class Real>
std::ptrdiff_t LatticeFluid<Real>::spread(std::span<const Vec3> x, const ibm::Selection& selection,
                                          std::span<const Vec3> f) {
  forces_clear_ = false;
  const ibm::NodeVectorView<Real> nodes{
      force_,
      n_layout_,
      {double(block().begin[0]), double(block().begin[1]), double(block().begin[2])}};
  return ibm::spread(parameters_.kernel, nodes, x, selection, f, simd_);
}

template <class Real>
std::ptrdiff_t LatticeFluid<Real>::interpolate(std::span<const Vec3> x,
                                               const ibm::Selection& selection,
                                               std::span<Vec3> u) const {
  const ibm::NodeVectorView<const Real> nodes{
      {u_[0], u_[1], u_[2]},
      n_layout_,
      {double(block().begin[0]), double(block().begin[1]), double(block().begin[2])}};
  return ibm::interpolate(parameters_.kernel, nodes, x, selection, u, simd_);
}

/// The block, with `halo` ghost layers along the first `axes_done` axes.
template <class Real>
lattice::NodeBox LatticeFluid<Real>::with_halo(int axes_done, int halo) const {
  NodeBox box{{0, 0, 0}, block().size};
  for (int d = 0; d < axes_done; ++d) {
    box.lo[d] -= halo;
    box.hi[d] += halo;
  }
  return box;
}

/// The slabs at both ends of an axis: ghosts, and the owned nodes next to them; along lower axes
/// the halo is included.
template <class Real>
typename LatticeFluid<Real>::Faces LatticeFluid<Real>::faces(int axis, int width) const {
  const NodeBox face = with_halo(axis, width);
  const int n = block().size[axis];
  Faces f{face, face, face, face, face};
  f.ghost_low.lo[axis] = -width, f.ghost_low.hi[axis] = 0;
  f.first.hi[axis] = width;
  f.last.lo[axis] = n - width;
  f.ghost_high.lo[axis] = n, f.ghost_high.hi[axis] = n + width;
  return f;
}

template <class Real> void LatticeFluid<Real>::reduce_forces() {
  if (forces_clear_) return;
  sum_forces_home();
  if (!has_vessel()) return;
  clear_force_halo();
  wall_shares_[0] += ghosts_.fold_force(force_);
  sum_forces_home();
}

/// Halo forces go home: z, then y, then x, so that edges and corners travel with the faces.
template <class Real> void LatticeFluid<Real>::sum_forces_home() {
  for (int axis = 2; axis >= 0; --axis) {
    const Faces at = faces(axis, n_layout_.halo);
    for (const auto& plate : plates_)
      if (plate.axis == axis)
        wall_shares_[plate.side == fluid::Side::high] +=
            fluid::fold_mirror_force(plate, force_, n_layout_, at.whole);
    halo_.start(axis, n_layout_, {force_, at.ghost_low}, {force_, at.last}, {force_, at.ghost_high},
                {force_, at.first}, Combine::add);
    halo_.finish();
  }
}

template <class Real> void LatticeFluid<Real>::clear_force_halo() {
  for (int axis = 0; axis < 3; ++axis) {
    const Faces at = faces(axis, n_layout_.halo);
    for (const NodeBox& ghost : {at.ghost_low, at.ghost_high})
      for (Real* component : force_)
        for_each_row(ghost, n_layout_,
                     [&](std::ptrdiff_t row, int n) { std::fill_n(component + row, n, Real(0)); });
  }
}

template <class Real> void LatticeFluid<Real>::exchange_velocity(int first_axis) {
  const auto exchange = [&](int first) {
    for (int axis = first; axis < 3; ++axis) {
      const Faces at = faces(axis, n_layout_.halo);
      halo_.start(axis, n_layout_, {u_, at.first}, {u_, at.ghost_high}, {u_, at.last},
                  {u_, at.ghost_low}, Combine::copy);
      if (halo_.remote(axis)) sweep_meanwhile();
      halo_.finish();
      for (const auto& plate : plates_)
        if (plate.axis == axis) fluid::fill_mirror_velocity(plate, u_, n_layout_, at.whole);
    }
  };
  exchange(first_axis);
  if (!has_vessel()) return;
  ghosts_.fill_velocity(u_);
  exchange(0);
}

template <class Real> void LatticeFluid<Real>::exchange_sources(int first_axis) {
  for (int axis = first_axis; axis < 3; ++axis) {
    const Faces at = faces(axis, 1);
    halo_.start(axis, f_layout_, {last_, at.first}, {last_, at.ghost_high}, {last_, at.last},
                {last_, at.ghost_low}, Combine::copy);
    if (halo_.remote(axis)) sweep_meanwhile();
    halo_.finish();
  }
}

/// The populations that cross a face normal to the axis in one sense.
template <class Real> std::array<Real*, 5> LatticeFluid<Real>::crossing(int axis, int sense) const {
  std::array<Real*, 5> crossing{};
  const auto directions = d3q19::crossing(axis, sense);
  for (std::size_t k = 0; k < 5; ++k) crossing[k] = f_[static_cast<std::size_t>(directions[k])];
  return crossing;
}

/// Before a shift pass: ghosts take the neighbours' populations that will enter, x, then y, then z.
template <class Real> void LatticeFluid<Real>::send_populations_forward() {
  for (int axis = wraps_x_ ? 1 : 0; axis < 3; ++axis) {
    const auto up = crossing(axis, 1), down = crossing(axis, -1);
    const Faces at = faces(axis, 1);
    // A local pass left f_i* in slot opposite(i): what goes up lies in the slots that point down.
    halo_.start(axis, f_layout_, {up, at.first}, {up, at.ghost_high}, {down, at.last},
                {down, at.ghost_low}, Combine::copy);
    if (halo_.remote(axis)) sweep_meanwhile();
    halo_.finish();
  }
}

/// After a shift pass: what was written to ghosts goes home, z, then y, then x.
template <class Real> void LatticeFluid<Real>::send_populations_home() {
  for (int axis = 2; axis >= (wraps_x_ ? 1 : 0); --axis) {
    const auto up = crossing(axis, 1), down = crossing(axis, -1);
    const Faces at = faces(axis, 1);
    halo_.start(axis, f_layout_, {down, at.ghost_low}, {down, at.last}, {up, at.ghost_high},
                {up, at.first}, Combine::copy);
    if (halo_.remote(axis)) sweep_meanwhile();
    halo_.finish();
  }
}

/// Walls turn populations back. They come after the exchanges, which also pass over edges that
/// belong to a plate. @return momentum given to the low and high plate, or to the vessel
template <class Real>
std::array<Vec3, 2> LatticeFluid<Real>::bounce(PlateRule plate_rule, LinkRule link_rule) {
  const double streamed =
      exponential() ? fluid::ExponentialRates(parameters_.relaxation.tau).streamed() : 1.0;
  std::array<Vec3, 2> given{};
  for (const auto& plate : plates_)
    given[plate.side == fluid::Side::high] += plate_rule(plate, f_, f_layout_, streamed);
  if (has_vessel()) given[0] += (links_.*link_rule)(f_, streamed);
  return given;
}

template <class Real> std::array<Vec3, 2> LatticeFluid<Real>::bounce_before_shift() {
  return bounce(fluid::bounce_before_shift<Real>, &fluid::WallLinks<Real>::bounce_before_shift);
}

template <class Real> std::array<Vec3, 2> LatticeFluid<Real>::bounce_after_shift() {
  return bounce(fluid::bounce_after_shift<Real>, &fluid::WallLinks<Real>::bounce_after_shift);
}

/// Exponential scheme: what the sweep would read beyond walls (fluid/exponential_walls.hpp).
template <class Real> std::array<Vec3, 2> LatticeFluid<Real>::reflect_source(int sense) {
  const fluid::ExponentialRates rates(parameters_.relaxation.tau);
  std::array<Vec3, 2> given{};
  for (const auto& plate : plates_)
    given[plate.side == fluid::Side::high] +=
        fluid::add_reflected_source(plate, next_, f_, last_, f_layout_, rates, sense);
  if (has_vessel())
    given[0] += fluid::add_reflected_source(links_, next_, f_, last_, f_layout_, rates, sense);
  return given;
}

template <class Real> void LatticeFluid<Real>::step() {
  reduce_forces();
  const bool shift = next_ == fluid::Pass::shift;
  const int first_axis = wraps_x_ ? 1 : 0;  // the sweep keeps the ghosts along x
  std::array<Vec3, 2> bounced{}, reflected{};
  plan_interior(shift);
  if (exponential()) exchange_sources(first_axis);
  if (shift) {
    send_populations_forward();
    bounced = bounce_before_shift();
  }
  if (exponential()) reflected = reflect_source(1);
  sweep_shell();
  exchange_velocity(first_axis);
  if (shift) {
    send_populations_home();
    if (wraps_x_) wrap_rows_home();
    book_wall_momentum(bounced, reflected_before_);
    book_wall_momentum(bounce_after_shift(), reflected);
  }
  reflected_before_ = reflected;
  if (exponential()) std::swap(last_, present_);
  next_ = shift ? fluid::Pass::local : fluid::Pass::shift;
}

/// The exponential scheme carries a part D of every change into the next step, so that a steady
/// force acts 1/(1 - D) times.
template <class Real>
void LatticeFluid<Real>::book_wall_momentum(const std::array<Vec3, 2>& bounced,
                                            const std::array<Vec3, 2>& reflected) {
  const double carried =
      exponential() ? fluid::ExponentialRates(parameters_.relaxation.tau).D : 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    wall_momentum_[side] = (bounced[side] + reflected[side]) / (1 - carried);
    wall_book_.momentum[side] += wall_momentum_[side];
  }
  ++wall_book_.steps;
}

/// Which rows can be swept behind messages: those farther from the block's faces along y and z than
/// any halo reaches.
template <class Real> void LatticeFluid<Real>::plan_interior(bool shift) {
  swept_.clear();
  interior_ = {};
  const int remote = halo_.remote(1) + halo_.remote(2), width = n_layout_.halo;
  const auto& n = block().size;
  interior_parts_ = remote * ((shift ? 3 : 1) + (exponential() ? 1 : 0));
  if (!wraps_x_ || remote == 0 || has_vessel() || n[1] <= 2 * width || n[2] <= 2 * width) return;
  interior_ = {{0, width, width}, {n[0], n[1] - width, n[2] - width}};
}

template <class Real> void LatticeFluid<Real>::sweep(const NodeBox& box) {
  if (box.count() == 0) return;
  fluid::sweep(next_, sweep_fields(box), parameters_.relaxation, simd_);
  swept_.push_back(box);
}

template <class Real> void LatticeFluid<Real>::sweep_shell() {
  const auto& n = block().size;
  const int width = n_layout_.halo;
  if (interior_.count() == 0 && swept_.empty()) return sweep({{0, 0, 0}, n});
  sweep({{0, 0, 0}, {n[0], n[1], width}});
  sweep({{0, 0, n[2] - width}, n});
  sweep({{0, 0, width}, {n[0], width, n[2] - width}});
  sweep({{0, n[1] - width, width}, {n[0], n[1], n[2] - width}});
}

/// Sweep the next part of the interior, as many planes as leave the same for every exchange to
/// come.
template <class Real> void LatticeFluid<Real>::sweep_meanwhile() {
  if (interior_parts_ == 0 || interior_.count() == 0) return;
  NodeBox part = interior_;
  const int planes = interior_.hi[2] - interior_.lo[2];
  part.hi[2] = part.lo[2] + (planes + interior_parts_ - 1) / interior_parts_;
  interior_.lo[2] = part.hi[2];
  --interior_parts_;
  sweep(part);
}

/// Rows at the border of a swept box got populations after the sweep had passed them: those that
/// cross x as well are passed on.
template <class Real> void LatticeFluid<Real>::wrap_rows_home() {
  const auto fields = sweep_fields({{0, 0, 0}, block().size});
  for (const NodeBox& box : swept_) {
    for (int z = box.lo[2]; z < box.hi[2]; ++z)
      for (const int y : {box.lo[1], box.hi[1] - 1}) fluid::wrap_row_home(fields, y, z);
    for (int y = box.lo[1]; y < box.hi[1]; ++y)
      for (const int z : {box.lo[2], box.hi[2] - 1}) fluid::wrap_row_home(fields, y, z);
  }
}

template <class Real>
fluid::SweepFields<Real> LatticeFluid<Real>::sweep_fields(const NodeBox& box) {
  fluid::SweepFields<Real> s{};
  std::copy(f_.begin(), f_.end(), s.f);
  std::copy(force_.begin(), force_.end(), s.force);
  std::copy(u_.begin(), u_.end(), s.u);
  std::copy(last_.begin(), last_.end(), s.last);
  std::copy(present_.begin(), present_.end(), s.present);
  s.distance = distance_;
  s.f_row = f_layout_.row, s.f_plane = f_layout_.plane;
  s.n_row = n_layout_.row, s.n_plane = n_layout_.plane;
  s.size_x = block().size[0], s.padded_x = f_layout_.padded_x;
  s.wrap_x = wraps_x_ ? block().size[0] : 0;
  s.n_halo = n_layout_.halo;
  s.y_lo = box.lo[1], s.y_hi = box.hi[1];
  s.z_lo = box.lo[2], s.z_hi = box.hi[2];
  return s;
}

template class LatticeFluid<double>;  // the members defined here; the others:
                                      // lattice_fluid_values.cpp
template class LatticeFluid<float>;

std::unique_ptr<FluidSolver> make_fluid(const Neighbourhood& at,
                                        const FluidParameters& parameters) {
  if (parameters.precision == Precision::single_)
    return std::make_unique<LatticeFluid<float>>(at, parameters);
  return std::make_unique<LatticeFluid<double>>(at, parameters);
}

}  // namespace hemomag::solver
