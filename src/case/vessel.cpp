#include "case/vessel.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"
#include "case/lattice_units.hpp"
#include "io/surface_file.hpp"
#include "lattice/surface_vessel.hpp"
#include "lattice/vessel.hpp"

namespace hemomag::case_ {
namespace {

std::shared_ptr<const lattice::Vessel> tube(const Case& c) {
  const double dx = c.numerics.dx;
  const auto& s = c.channel.size;
  return std::make_shared<lattice::Tube>(c.channel.axis, 0.5 / dx * Vec3{s[0], s[1], s[2]},
                                         0.5 * c.channel.diameter / dx);
}

std::shared_ptr<const lattice::Vessel> surface(const Case& c) {
  lattice::Surface s = io::read_surface(c.channel.geometry);
  for (Vec3& x : s.points) x = surface_scale(c) * x;
  return std::make_shared<lattice::SurfaceVessel>(s);
}

/// Which nodes lie in the fluid, x fastest. No wall is nearer to a point than its distance, so that
/// along a row the nodes within it need not be asked; half of it is used, to meet the widest place.
std::vector<bool> mark_fluid(VesselOnGrid& vessel, const std::array<int, 3>& n) {
  std::vector<bool> fluid(static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
                          static_cast<std::size_t>(n[2]));
  std::size_t at = 0;
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0];) {
        const double d = vessel.wall->distance({x + 0.5, y + 0.5, z + 0.5});
        vessel.widest = std::max(vessel.widest, d);
        const double alike =
            std::min(std::max(1.0, std::floor(0.5 * std::fabs(d))), 1.0 * n[0] - x);
        for (int k = 0; k < static_cast<int>(alike); ++k, ++x) fluid[at++] = d > 0;
        if (d > 0) vessel.fluid_nodes += static_cast<long>(alike);
      }
  return fluid;
}

/// Compare the box's faces: the fluid that leaves through one enters at the opposite one.
void compare_ends(VesselOnGrid& vessel, const std::vector<bool>& fluid,
                  const std::array<int, 3>& n) {
  const auto node = [&](std::array<int, 3> i) {
    return static_cast<bool>(
        fluid[(static_cast<std::size_t>(i[2]) * static_cast<std::size_t>(n[1]) +
               static_cast<std::size_t>(i[1])) *
                  static_cast<std::size_t>(n[0]) +
              static_cast<std::size_t>(i[0])]);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    std::array<int, 3> low{}, high{};
    high[axis] = n[axis] - 1;
    for (low[a] = 0; low[a] < n[a]; ++low[a])
      for (low[b] = 0; low[b] < n[b]; ++low[b]) {
        high[a] = low[a], high[b] = low[b];
        vessel.open[axis] += node(low) && node(high);
        vessel.unmatched[axis] += node(low) != node(high);
      }
  }
}

}  // namespace

VesselOnGrid make_vessel(const Case& c) {
  VesselOnGrid vessel;
  if (c.channel.boundary == Boundary::tube) vessel.wall = tube(c);
  if (c.channel.boundary != Boundary::voxels) return vessel;
  vessel.wall = surface(c);
  const auto n = nodes(c);
  compare_ends(vessel, mark_fluid(vessel, n), n);
  if (vessel.fluid_nodes == 0)
    throw Error(c.channel.geometry +
                ": no node of the box lies inside the surface; accepted: a surface around a part "
                "of channel.size, its origin in the box's corner (see geometry_unit)");
  return vessel;
}

std::string geometry_copy(const Case& c) {
  if (c.channel.boundary != Boundary::voxels) return {};
  return "geometry" + std::filesystem::path(c.channel.geometry).extension().string();
}

double fluid_volume(const Case& c) {
  const auto& s = c.channel.size;
  if (c.channel.boundary == Boundary::tube)
    return std::numbers::pi / 4 * c.channel.diameter * c.channel.diameter *
           s[static_cast<std::size_t>(c.channel.axis)];
  if (c.channel.boundary == Boundary::voxels)
    return static_cast<double>(c.vessel.fluid_nodes) * std::pow(c.numerics.dx, 3);
  return s[0] * s[1] * s[2];
}

double wall_distance(const Case& c, Vec3 x) {
  // A tube does not notice its periods, and a point beside its box must not come in on the other
  // side; a surface has to be asked inside the box, where it is known.
  if (c.channel.boundary == Boundary::voxels)
    for (std::size_t d = 0; d < 3; ++d) {
      const double length = c.channel.size[d];
      x[d] -= length * std::floor(x[d] / length);
    }
  return c.numerics.dx * c.vessel.wall->distance(x / c.numerics.dx);
}

}  // namespace hemomag::case_
