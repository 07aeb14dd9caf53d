// Compiled once per instruction set (hemo_simd): collects the neighbours within the cut-off,
// computes Eq. 24 for all of them in loops that vectorise, and adds the forces one after the other,
// so that the sum on a carrier has a fixed order. magnetic/dipole.hpp has the law for one pair.
#include "magnetic/dipole_rows.hpp"

namespace hemomag::magnetic::HEMOMAG_SIMD {

std::ptrdiff_t dipole_row(const DipoleRow& a) {
  const double* x_i = a.x + 3 * static_cast<std::ptrdiff_t>(a.i);
  const double* m_i = a.m + 3 * static_cast<std::ptrdiff_t>(a.i);
  int near[most_in_row];
  alignas(64) double rx[most_in_row], ry[most_in_row], rz[most_in_row];
  alignas(64) double mx[most_in_row], my[most_in_row], mz[most_in_row];
  std::ptrdiff_t n = 0, touching = 0;
  for (std::ptrdiff_t k = 0; k < a.count; ++k) {
    const int j = a.neighbours[k] & a.index_mask;
    const double* x_j = a.x + 3 * static_cast<std::ptrdiff_t>(j);
    const double x = x_j[0] - x_i[0], y = x_j[1] - x_i[1], z = x_j[2] - x_i[2];
    const double r2 = x * x + y * y + z * z;
    // Every neighbour is written and only those within reach are kept: a branch would be
    // mispredicted for most.
    near[n] = j;
    rx[n] = x, ry[n] = y, rz[n] = z;
    n += r2 < a.cutoff2;
    a.touching[touching] = j;
    touching += r2 < a.contact2;
  }
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const double* m_j = a.m + 3 * static_cast<std::ptrdiff_t>(near[k]);
    mx[k] = m_j[0], my[k] = m_j[1], mz[k] = m_j[2];
  }
  const double ux = m_i[0], uy = m_i[1], uz = m_i[2];
  constexpr double three_over_4pi = 0.23873241463784300365;
  double fx = 0, fy = 0, fz = 0;
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const double inverse2 = 1 / (rx[k] * rx[k] + ry[k] * ry[k] + rz[k] * rz[k]);
    const double inverse = __builtin_sqrt(inverse2);
    const double ir = ux * rx[k] + uy * ry[k] + uz * rz[k];
    const double jr = mx[k] * rx[k] + my[k] * ry[k] + mz[k] * rz[k];
    const double ij = ux * mx[k] + uy * my[k] + uz * mz[k];
    const double along = 5 * (ir * jr) * inverse2 - ij;
    const double factor = three_over_4pi * inverse2 * inverse2 * inverse;
    // The moment's place in memory takes the force.
    mx[k] = factor * (ir * mx[k] + jr * ux - along * rx[k]);
    my[k] = factor * (ir * my[k] + jr * uy - along * ry[k]);
    mz[k] = factor * (ir * mz[k] + jr * uz - along * rz[k]);
  }
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    double* f_j = a.f + 3 * static_cast<std::ptrdiff_t>(near[k]);
    f_j[0] += mx[k], f_j[1] += my[k], f_j[2] += mz[k];
    fx += mx[k], fy += my[k], fz += mz[k];
  }
  double* f_i = a.f + 3 * static_cast<std::ptrdiff_t>(a.i);
  f_i[0] -= fx, f_i[1] -= fy, f_i[2] -= fz;
  return touching;
}

}  // namespace hemomag::magnetic::HEMOMAG_SIMD
