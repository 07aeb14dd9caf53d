#include "lattice/triangle_crossing.hpp"

#include <algorithm>
#include <cstddef>

namespace hemomag::lattice {
namespace {

__extension__ using Wide = __int128;
using WidePoint = std::array<Wide, 3>;

int sign(Wide a) { return a > 0 ? 1 : a < 0 ? -1 : 0; }

WidePoint difference(const GridPoint& a, const GridPoint& b) {
  return {Wide{a[0]} - b[0], Wide{a[1]} - b[1], Wide{a[2]} - b[2]};
}

WidePoint cross(const WidePoint& a, const WidePoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// On which side of the plane a, b, c the point d lies: the sign of the determinant.
int side(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const WidePoint n = cross(difference(b, a), difference(c, a)), r = difference(d, a);
  return sign(n[0] * r[0] + n[1] * r[1] + n[2] * r[2]);
}

/// The same in the plane left when `axis` is dropped: on which side of the line a b the point c is.
int side_in_plane(const GridPoint& a, const GridPoint& b, const GridPoint& c, std::size_t axis) {
  return sign(cross(difference(b, a), difference(c, a))[axis]);
}

bool boxes_overlap(const GridTriangle& s, const GridTriangle& t) {
  for (std::size_t d = 0; d < 3; ++d) {
    const auto [s_low, s_high] = std::minmax({s[0][d], s[1][d], s[2][d]});
    const auto [t_low, t_high] = std::minmax({t[0][d], t[1][d], t[2][d]});
    if (s_high < t_low || t_high < s_low) return false;
  }
  return true;
}

bool opposite(int a, int b) { return a * b <= 0; }

/// Whether the segments a b and c d of one plane meet, seen along `axis`.
bool segments_meet(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d,
                   std::size_t axis) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == axis) continue;
    if (std::max(a[k], b[k]) < std::min(c[k], d[k])) return false;
    if (std::max(c[k], d[k]) < std::min(a[k], b[k])) return false;
  }
  return opposite(side_in_plane(a, b, c, axis), side_in_plane(a, b, d, axis)) &&
         opposite(side_in_plane(c, d, a, axis), side_in_plane(c, d, b, axis));
}

bool contains(const GridTriangle& t, const GridPoint& p, std::size_t axis) {
  const std::array<int, 3> s = {side_in_plane(t[0], t[1], p, axis),
                                side_in_plane(t[1], t[2], p, axis),
                                side_in_plane(t[2], t[0], p, axis)};
  const auto [low, high] = std::minmax({s[0], s[1], s[2]});
  return low >= 0 || high <= 0;
}

/// Whether the triangles of one plane overlap.
bool overlap(const GridTriangle& s, const GridTriangle& t) {
  if (!boxes_overlap(s, t)) return false;
  std::size_t axis = 3;
  for (const GridTriangle* k : {&s, &t}) {
    const WidePoint n = cross(difference((*k)[1], (*k)[0]), difference((*k)[2], (*k)[0]));
    for (std::size_t d = 0; d < 3; ++d)
      if (n[d] != 0) axis = d;
  }
  if (axis == 3) return true;  // two segments or points whose boxes overlap
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (segments_meet(s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3], axis)) return true;
  return contains(t, s[0], axis) || contains(s, t[0], axis);
}

/// Whether the segment p q meets the triangle, given the sides of its plane on which p and q lie.
bool pierces(const GridPoint& p, int side_p, const GridPoint& q, int side_q,
             const GridTriangle& t) {
  if (!opposite(side_p, side_q) || (side_p == 0 && side_q == 0)) return false;
  const std::array<int, 3> s = {side(p, q, t[0], t[1]), side(p, q, t[1], t[2]),
                                side(p, q, t[2], t[0])};
  const auto [low, high] = std::minmax({s[0], s[1], s[2]});
  return low >= 0 || high <= 0;
}

std::array<int, 3> sides(const GridTriangle& plane, const GridTriangle& of) {
  return {side(plane[0], plane[1], plane[2], of[0]), side(plane[0], plane[1], plane[2], of[1]),
          side(plane[0], plane[1], plane[2], of[2])};
}

bool all_beyond(const std::array<int, 3>& s) { return s[0] != 0 && s[0] == s[1] && s[1] == s[2]; }

bool zero(const std::array<int, 3>& s) { return s[0] == 0 && s[1] == 0 && s[2] == 0; }

}  // namespace

bool triangles_cross(const GridTriangle& s, const GridTriangle& t) {
  if (!boxes_overlap(s, t)) return false;
  const auto of_s = sides(t, s), of_t = sides(s, t);
  if (all_beyond(of_s) || all_beyond(of_t)) return false;
  // All zero: in one plane, or one of them spans none.
  if (zero(of_s) && zero(of_t)) return overlap(s, t);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (pierces(s[k], of_s[k], s[next], of_s[next], t)) return true;
    if (pierces(t[k], of_t[k], t[next], of_t[next], s)) return true;
  }
  return false;
}

}  // namespace hemomag::lattice
