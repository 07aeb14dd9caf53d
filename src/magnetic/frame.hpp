#pragma once
#include "magnetic/field_at.hpp"

namespace hemomag::magnetic {

/// Axes of a body, right-handed and of length one, about its centre.
struct Frame {
  Vec3 origin;
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  /// Axes whose third is along `axis` and whose first is nearest to `across`.
  /// @param across  not parallel to axis
  static Frame along(const Vec3& origin, const Vec3& axis, const Vec3& across);
  /// Of a body of revolution, for which any first axis will do.
  static Frame along(const Vec3& origin, const Vec3& axis);

  Vec3 components(const Vec3& v) const {
    return {dot(v, axes[0]), dot(v, axes[1]), dot(v, axes[2])};
  }
  Vec3 vector(const Vec3& c) const { return c.x * axes[0] + c.y * axes[1] + c.z * axes[2]; }
  Vec3 place(const Vec3& c) const { return origin + vector(c); }
  Vec3 local(const Vec3& x) const { return components(x - origin); }
  /// A field given in components along the axes, derivatives too.
  FieldAt world(const FieldAt& local) const;
};

inline Frame Frame::along(const Vec3& origin, const Vec3& axis, const Vec3& across) {
  Frame frame{origin};
  auto& e = frame.axes;
  e[2] = axis / norm(axis);
  e[0] = across - dot(across, e[2]) * e[2];
  e[0] *= 1 / norm(e[0]);
  e[1] = cross(e[2], e[0]);
  return frame;
}

inline Frame Frame::along(const Vec3& origin, const Vec3& axis) {
  // The coordinate axis that is farthest from being parallel.
  const Vec3 size{std::fabs(axis.x), std::fabs(axis.y), std::fabs(axis.z)};
  Vec3 across;
  across[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1;
  return along(origin, axis, across);
}

inline FieldAt Frame::world(const FieldAt& local) const {
  FieldAt at;
  at.B = vector(local.B);
  std::array<Vec3, 3> along_axis;  // dB/d(local a) as vectors of space
  for (std::size_t a = 0; a < 3; ++a) along_axis[a] = vector(local.gradient[a]);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t a = 0; a < 3; ++a) at.gradient[c] += axes[a][c] * along_axis[a];
  return at;
}

}  // namespace hemomag::magnetic
