#pragma once
#include <algorithm>
#include <array>

#include "base/vec3.hpp"

namespace hemomag::lattice {

using Triangle = std::array<Vec3, 3>;

/// A point of a triangle: the sum of weight[k] times corner k.
struct TrianglePoint {
  Vec3 x;
  std::array<double, 3> weight;  ///< each in [0, 1], their sum 1
};

/// The point of a triangle that is nearest to p, found by the region of its plane over which p lies
/// (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
inline TrianglePoint nearest_point(const Vec3& p, const Triangle& t) {
  const auto& [a, b, c] = t;
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {a, {1, 0, 0}};
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {b, {0, 1, 0}};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double v = d1 / (d1 - d3);
    return {a + v * ab, {1 - v, v, 0}};
  }
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {c, {0, 0, 1}};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return {a + w * ac, {1 - w, 0, w}};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {b + w * (c - b), {0, 1 - w, w}};
  }
  const double sum = va + vb + vc, v = vb / sum, w = vc / sum;
  return {a + v * ab + w * ac, {1 - v - w, v, w}};
}

/// Squared distance of the segments p0 p1 and q0 q1 (Ericson 2005, section 5.1.9). Neither may be a
/// point.
inline double segment_distance2(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
  const Vec3 u = p1 - p0, v = q1 - q0, r = p0 - q0;
  const double a = norm2(u), e = norm2(v), b = dot(u, v), c = dot(u, r), f = dot(v, r);
  const double parallel = a * e - b * b;
  double s = parallel > 1e-14 * a * e ? std::clamp((b * f - c * e) / parallel, 0.0, 1.0) : 0.0;
  double t = (b * s + f) / e;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((b * t - c) / a, 0.0, 1.0);
  }
  return norm2(r + s * u - t * v);
}

/// Squared distance of two triangles that do not cross: that of a corner and a triangle, or of two
/// edges.
inline double triangle_distance2(const Triangle& s, const Triangle& t) {
  double least = norm2(s[0] - t[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min(least, norm2(s[i] - nearest_point(s[i], t).x));
    least = std::min(least, norm2(t[i] - nearest_point(t[i], s).x));
    for (std::size_t j = 0; j < 3; ++j)
      least = std::min(least, segment_distance2(s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3]));
  }
  return least;
}

}  // namespace hemomag::lattice
