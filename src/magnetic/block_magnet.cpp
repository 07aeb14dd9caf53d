#include "magnetic/block_magnet.hpp"

#include <algorithm>
#include <numbers>

namespace hemomag::magnetic {
namespace {

/// Distances of a place from the faces of a block, lower and upper, along each axis, and from its
/// corners.
struct Corners {
  std::array<std::array<double, 2>, 3> d;  ///< [axis][face]
  double R[2][2][2];                       ///< [x face][y face][z face]

  Corners(const Vec3& x, const Vec3& half) {
    for (std::size_t a = 0; a < 3; ++a) d[a] = {x[a] + half[a], x[a] - half[a]};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        for (std::size_t k = 0; k < 2; ++k)
          R[i][j][k] = std::sqrt(d[0][i] * d[0][i] + d[1][j] * d[1][j] + d[2][k] * d[2][k]);
  }

  /// R of face i across axis a, j across b and k across c.
  double at(std::size_t a, std::size_t i, std::size_t b, std::size_t j, std::size_t c,
            std::size_t k) const {
    std::size_t face[3];
    face[a] = i, face[b] = j, face[c] = k;
    return R[face[0]][face[1]][face[2]];
  }
};

/// An edge along axis c as a place sees it: from its lower end (1) to its upper (2), Z1 > Z2.
struct Edge {
  double q;  ///< squared distance from the edge's line
  double Z1, Z2, R1, R2;

  /// (Z1 + R1)/(Z2 + R2) without cancellation beside, before or behind the edge.
  double ratio() const {
    if (Z2 >= 0) return (Z1 + R1) / (Z2 + R2);
    if (Z1 <= 0) return (R2 - Z2) / (R1 - Z1);
    return (Z1 + R1) * (R2 - Z2) / q;
  }

  /// (Z1/R1 - Z2/R2)/q, finite on the edge's extensions, where q = 0.
  double pull() const {
    const double cosine1 = Z1 / R1, cosine2 = Z2 / R2;
    if (Z1 > 0 && Z2 < 0) return (cosine1 - cosine2) / q;
    return (Z1 - Z2) * (Z1 + Z2) / (R1 * R1 * R2 * R2 * (cosine1 + cosine2));
  }
};

/// sum s atan(Y Z/(X R)), the diagonal element of axis a.
double angles(const Corners& corners, std::size_t a) {
  const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
  double sum = 0;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t k = 0; k < 2; ++k) {
        // X = 0 is a face's plane: any sign of it cancels between the corners, outside the face.
        const double X = corners.d[a][i], YZ = corners.d[b][j] * corners.d[c][k];
        const double angle =
            std::atan2(X < 0 ? -YZ : YZ, std::fabs(X) * corners.at(a, i, b, j, c, k));
        sum += (i + j + k) % 2 == 1 ? angle : -angle;
      }
  return sum;
}

/// N_ab and its derivatives for two different axes a and b.
struct Mixed {
  double N, along_a, along_b;
};

Mixed mixed(const Corners& corners, std::size_t a, std::size_t b) {
  const std::size_t c = 3 - a - b;
  double ratios = 1, along_a = 0, along_b = 0;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const double X = corners.d[a][i], Y = corners.d[b][j];
      const Edge edge{X * X + Y * Y, corners.d[c][0], corners.d[c][1], corners.at(a, i, b, j, c, 0),
                      corners.at(a, i, b, j, c, 1)};
      const double s = i == j ? 1 : -1, pull = s * edge.pull();
      ratios *= i == j ? edge.ratio() : 1 / edge.ratio();
      along_a -= X * pull;
      along_b -= Y * pull;
    }
  return {std::log(ratios), along_a, along_b};
}

}  // namespace

FieldAt BlockMagnet::operator()(const Vec3& place) const {
  const Corners corners(frame.local(place), half);
  double N[3][3], T[3][3][3];  // N_ab and dN_ab/dx_c, symmetric in all indices where curl B = 0
  double corner_sum = 0;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t k = 0; k < 2; ++k)
        corner_sum += ((i + j + k) % 2 == 1 ? -1 : 1) / corners.R[i][j][k];
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Mixed m = mixed(corners, a, b);
      N[a][b] = N[b][a] = m.N;
      T[a][a][b] = T[a][b][a] = T[b][a][a] = m.along_a;
      T[b][b][a] = T[b][a][b] = T[a][b][b] = m.along_b;
      const std::size_t c = 3 - a - b;
      T[a][b][c] = T[b][a][c] = corner_sum;
    }
  for (std::size_t a = 0; a < 2; ++a) N[a][a] = angles(corners, a);
  N[2][2] = -N[0][0] - N[1][1];  // div B = 0 outside
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    T[a][a][a] = -T[a][b][b] - T[a][c][c];
  }
  FieldAt at;
  const Vec3 J = (0.25 / std::numbers::pi) * remanence;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      at.B[b] += J[a] * N[a][b];
      for (std::size_t c = 0; c < 3; ++c) at.gradient[c][b] += J[a] * T[a][b][c];
    }
  return frame.world(at);
}

Vec3 BlockMagnet::nearest(const Vec3& x) const {
  Vec3 p = frame.local(x);
  for (std::size_t a = 0; a < 3; ++a) p[a] = std::clamp(p[a], -half[a], half[a]);
  return frame.place(p);
}

}  // namespace hemomag::magnetic
