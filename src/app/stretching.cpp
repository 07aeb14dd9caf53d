#include "app/stretching.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/error.hpp"
#include "base/minimise.hpp"

namespace hemomag::app {
namespace {

constexpr double wanted_residual = 2e-4;  // pN; extents then are good to 1e-4 um
constexpr double worst_residual = 1e-3;   // pN

}  // namespace

Grips grips(const std::vector<Vec3>& rest, double fraction) {
  std::vector<int> order(rest.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return rest[a].x < rest[b].x; });
  const auto count = std::max(1L, std::lround(fraction * static_cast<double>(rest.size())));
  return {{order.begin(), order.begin() + count}, {order.end() - count, order.end()}};
}

std::vector<Vec3> turned(std::vector<Vec3> x, double degrees) {
  const double c = std::cos(degrees * std::numbers::pi / 180);
  const double s = std::sin(degrees * std::numbers::pi / 180);
  for (Vec3& p : x) p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  return x;
}

Stretched measure(const membrane::WholeCell& network, const std::vector<Vec3>& x, double force) {
  Vec3 low = x[0], high = x[0];
  for (const Vec3& p : x)
    for (std::size_t d = 0; d < 3; ++d)
      low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  Stretched s;
  s.force = force;
  s.D_A = high.x - low.x;
  s.D_T = high.y - low.y;
  s.D_z = high.z - low.z;
  s.area_change = network.area(x) / network.rest_area() - 1;
  s.volume_change = network.volume(x) / network.rest_volume() - 1;
  s.extension = network.largest_extension(x);
  s.x = x;
  return s;
}

std::vector<Stretched> stretch(const membrane::TriangleMesh& mesh, const membrane::Moduli& moduli,
                               const std::vector<double>& forces, const StretchOptions& options) {
  membrane::TriangleMesh rest = mesh;
  rest.x = turned(mesh.x, options.direction);
  const membrane::WholeCell network(rest, moduli);
  const Grips held = grips(rest.x, options.fraction);
  std::vector<Vec3> x = rest.x, before = rest.x;
  std::vector<Stretched> states;
  for (const double force : forces) {
    const double each = force / static_cast<double>(held.low.size());
    const auto loaded = [&](const std::vector<Vec3>& at, std::vector<Vec3>& f) {
      double energy = network.energy(at, f);
      for (const int v : held.low) f[v].x -= each, energy += each * at[v].x;
      for (const int v : held.high) f[v].x += each, energy -= each * at[v].x;
      return energy;
    };
    // Start where the last two forces point, but not all the way.
    const std::vector<Vec3> last = x;
    std::vector<Vec3> f(x.size());
    if (states.size() > 1) {
      const double f1 = states.back().force, f0 = states[states.size() - 2].force;
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += 0.7 * (force - f1) / (f1 - f0) * (last[i] - before[i]);
      if (!std::isfinite(loaded(x, f))) x = last;
    }
    before = last;
    MinimiseOptions how;
    how.largest_force = wanted_residual;
    const Minimum found = minimise(x, loaded, how);
    if (found.largest_force > worst_residual)
      throw Error("stretching at " + std::to_string(force) +
                  " pN: " + std::to_string(found.largest_force) +
                  " pN are left on a vertex, need " + std::to_string(worst_residual));
    states.push_back(measure(network, x, force));
    states.back().residual = found.largest_force;
  }
  return states;
}

}  // namespace hemomag::app
