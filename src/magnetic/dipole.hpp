#pragma once
#include <cmath>
#include <numbers>

#include "base/vec3.hpp"

// Forces between two carriers: point dipoles, and a repulsion that stands for their finite size.
// mu* = 1. r = x_j - x_i points from i to j; forces are those on j, and i gets the negative.

namespace hemomag::magnetic {

struct PairForce {
  Vec3 on_j;
  double energy;
};

/// Eq. 24 and its energy (1/4 pi r^3)(m_i . m_j - 3 (m_i . e)(m_j . e)), at fixed moments.
inline PairForce dipole_dipole(const Vec3& m_i, const Vec3& m_j, const Vec3& r) {
  const double r2 = norm2(r), distance = std::sqrt(r2);
  const Vec3 e = r / distance;
  const double ie = dot(m_i, e), je = dot(m_j, e), ij = dot(m_i, m_j);
  const double prefactor = 1 / (4 * std::numbers::pi * r2 * distance);
  return {(3 * prefactor / distance) * (ie * m_j + je * m_i - (5 * ie * je - ij) * e),
          prefactor * (ij - 3 * ie * je)};
}

/// Pull between two moments that point along the line of centres at contact, 6 m_i m_j/(4 pi d^4):
/// F0/8 for two equal spheres of radius a = d/2, F0 = 3 mu* m^2/(4 pi a^4).
inline double contact_pull(double m_i, double m_j, double contact_distance) {
  const double d2 = contact_distance * contact_distance;
  return 1.5 * m_i * m_j / (std::numbers::pi * d2 * d2);
}

/// Soft repulsion A exp(-kappa (r/d - 1)) with A the contact pull, so that the gap at rest does not
/// depend on the field. Differs from eq. (26): that force is singular at contact and weakly
/// attractive beyond its range.
inline PairForce soft_repulsion(double amplitude, double kappa, double d, const Vec3& r) {
  const double distance = norm(r);
  const double force = amplitude * std::exp(-kappa * (distance / d - 1));
  return {(force / distance) * r, force * d / kappa};
}

/// Repulsion of Eq. 26, epsilon/s [(sigma/s)^12 - (sigma/s)^6] with s = r - d, cut where it changes
/// sign, at s = sigma. Differs from eq. (26): the weakly attractive tail beyond s = sigma is left
/// out. Energy zero at the cut.
inline PairForce paper_repulsion(double epsilon, double sigma, double d, const Vec3& r) {
  const double distance = norm(r), s = distance - d;
  if (s >= sigma) return {};
  const double q = sigma / s, q6 = q * q * q * q * q * q;
  const double force = epsilon / s * (q6 * q6 - q6);
  return {(force / distance) * r, epsilon * (q6 * q6 / 12 - q6 / 6 + 1.0 / 12)};
}

/// Largest stiffness -dF/dr of the soft repulsion near contact.
inline double soft_stiffness(double amplitude, double kappa, double d) {
  return amplitude * kappa / d;
}

/// Stiffness of Eq. 26 where it balances a pull `load`: F ~ epsilon sigma^12/s^13, so 13 load/s.
inline double paper_stiffness(double load, double epsilon, double sigma) {
  if (!(load > 0)) return 13 * epsilon / (sigma * sigma);
  return 13 * load / (sigma * std::pow(epsilon / (load * sigma), 1.0 / 13));
}

}  // namespace hemomag::magnetic
