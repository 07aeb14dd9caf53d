#include "analysis/cell_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemomag::analysis {
namespace {

using Matrix = std::array<Vec3, 3>;  // columns

/// Turn axes p and q of a symmetric matrix so that m[p][q] vanishes, and the basis with them
/// (Jacobi; Press et al., Numerical Recipes, 11.1).
void rotate_away(Matrix& m, Matrix& basis, std::size_t p, std::size_t q) {
  if (m[p][q] == 0) return;
  const double half = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const double t = std::copysign(1.0, half) / (std::fabs(half) + std::hypot(half, 1.0));
  const double c = 1 / std::hypot(t, 1.0), s = t * c;
  for (std::size_t k = 0; k < 3; ++k) {
    const double kp = m[p][k], kq = m[q][k];
    m[p][k] = c * kp - s * kq;
    m[q][k] = s * kp + c * kq;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double pk = m[k][p], qk = m[k][q];
    m[k][p] = c * pk - s * qk;
    m[k][q] = s * pk + c * qk;
  }
  const Vec3 along_p = basis[p], along_q = basis[q];
  basis[p] = c * along_p - s * along_q;
  basis[q] = s * along_p + c * along_q;
}

/// Eigenvectors of a symmetric matrix, which is left diagonal. Ten sweeps are more than a 3 x 3
/// matrix needs: convergence is quadratic.
Matrix eigenvectors(Matrix& m) {
  Matrix basis{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  for (int sweep = 0; sweep < 10; ++sweep) {
    rotate_away(m, basis, 0, 1);
    rotate_away(m, basis, 0, 2);
    rotate_away(m, basis, 1, 2);
  }
  return basis;
}

Vec3 signed_direction(const Vec3& v) {
  const Vec3 side{1, std::numbers::sqrt2, std::numbers::sqrt3};
  return dot(v, side) < 0 ? -v : v;
}

double semi_axis(double lambda) { return std::sqrt(5 * std::max(lambda, 0.0)); }

}  // namespace

void SolidMoments::add(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double D = dot(a, cross(b, c));
  const Vec3 s = a + b + c;
  area += 0.5 * norm(cross(b - a, c - a));
  volume += D / 6;
  first += D / 24 * s;
  constexpr std::size_t row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t i = row[k], j = column[k];
    second[k] += D / 120 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + s[i] * s[j]);
  }
}

CellShape cell_shape(const SolidMoments& moments) {
  CellShape shape{};
  shape.area = moments.area;
  shape.volume = moments.volume;
  const Vec3 C = moments.first / moments.volume;
  shape.centre = C;
  const auto& M = moments.second;
  const double V = moments.volume;
  const double xx = M[0] / V - C.x * C.x, yy = M[1] / V - C.y * C.y, zz = M[2] / V - C.z * C.z,
               yz = M[3] / V - C.y * C.z, xz = M[4] / V - C.x * C.z, xy = M[5] / V - C.x * C.y;

  Matrix m{Vec3{xx, xy, xz}, Vec3{xy, yy, yz}, Vec3{xz, yz, zz}};
  const Matrix basis = eigenvectors(m);
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return m[i][i] > m[j][j]; });
  for (std::size_t k = 0; k < 3; ++k) {
    shape.semi_axes[k] = semi_axis(m[order[k]][order[k]]);
    shape.directions[k] = signed_direction(basis[order[k]]);
  }
  const double a = shape.semi_axes[0], c = shape.semi_axes[2];
  shape.taylor = (a - c) / (a + c);

  const double mean = (yy + zz) / 2, half_gap = std::hypot((yy - zz) / 2, yz);
  const double A = semi_axis(mean + half_gap), B = semi_axis(mean - half_gap);
  shape.taylor_in_plane = (A - B) / (A + B);
  shape.inclination = std::atan2(2 * yz, yy - zz) / 2;
  // atan2 tells -pi from pi by the sign of a zero; the same direction has one angle here.
  if (shape.inclination <= -std::numbers::pi / 2) shape.inclination += std::numbers::pi;
  return shape;
}

double nearest_turn(double angle, double last, double period) {
  return angle + period * std::round((last - angle) / period);
}

}  // namespace hemomag::analysis
