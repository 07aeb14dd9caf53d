// Surfaces of vessels and cells. The first byte of an input is the first letter of the file's
// ending.
#include <cmath>
#include <set>
#include <utility>

#include "contract.hpp"
#include "io/surface_file.hpp"
#include "lattice/surface_vessel.hpp"

namespace {

using namespace hemomag;

/// What lattice::closed promises.
void expect_closed(const lattice::Surface& s) {
  const int n = static_cast<int>(s.points.size());
  std::set<std::pair<int, int>> edges;
  double volume = 0;
  for (const auto& t : s.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      fuzz::require(t[k] >= 0 && t[k] < n, "corners are points");
      fuzz::require(edges.emplace(t[k], t[(k + 1) % 3]).second, "an edge is run along once");
    }
    const auto x = [&](std::size_t k) {
      return s.points[static_cast<std::size_t>(t[k])] - s.points[0];
    };
    volume += dot(x(0), cross(x(1), x(2)));
  }
  for (const auto& [a, b] : edges)
    fuzz::require(edges.contains({b, a}), "an edge is run along in both senses");
  fuzz::require(volume > 0, "the surface is outward");
}

void read_mesh(const std::string& path) {
  const lattice::Surface surface = io::read_surface(path);
  expect_closed(surface);
  const lattice::SurfaceVessel vessel(surface);
  Vec3 low = surface.points[0], high = low;
  for (const Vec3& x : surface.points)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
  for (const double part : {-1.0, 0.0, 0.25, 0.5})
    fuzz::require(std::isfinite(vessel.distance(low + part * (high - low))),
                  "distances are finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const char* name = data[0] == 's' ? "a.stl" : data[0] == 'o' ? "a.off" : "a.ply";
  const std::string path = fuzz::directory().write(name, fuzz::bytes(data + 1, size - 1));
  fuzz::value_or_error([&] { read_mesh(path); });
  return 0;
}
