#pragma once
#include <cmath>
#include <cstddef>

#include "base/vec3.hpp"

namespace hemomag::lattice {

/// The space a fluid fills, bounded by walls at rest.
class Vessel {
public:
  virtual ~Vessel() = default;

  /// Distance of a point to the nearest wall, positive in the fluid and negative beyond the wall.
  /// Lattice units, in the frame of the whole grid (node i at i + 1/2).
  virtual double distance(const Vec3& x) const = 0;
};

/// A round tube without ends.
class Tube : public Vessel {
public:
  /// @param axis    0, 1 or 2
  /// @param centre  a point of the axis
  Tube(int axis, const Vec3& centre, double radius)
      : axis_(static_cast<std::size_t>(axis)), centre_(centre), radius_(radius) {}

  double distance(const Vec3& x) const override {
    Vec3 r = x - centre_;
    r[axis_] = 0;
    return radius_ - norm(r);
  }

private:
  std::size_t axis_;
  Vec3 centre_;
  double radius_;
};

}  // namespace hemomag::lattice
