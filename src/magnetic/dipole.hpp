#pragma once
#include <algorithm>
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

/// Eq. 24 and its energy (1/4 pi r^3)(m_i . m_j - 3 (m_i . e)(m_j . e)), at fixed moments. Written
/// so that exchanging i and j changes the sign of every rounded term: the third law holds to the
/// last bit (without fused multiply-add).
inline PairForce dipole_dipole(const Vec3& m_i, const Vec3& m_j, const Vec3& r) {
  const double inverse2 = 1 / norm2(r), inverse = std::sqrt(inverse2);
  const double prefactor = inverse2 * inverse / (4 * std::numbers::pi);
  const double ir = dot(m_i, r), jr = dot(m_j, r), ij = dot(m_i, m_j);
  const double both = (ir * jr) * inverse2;
  return {(3 * prefactor * inverse2) * ((ir * m_j + jr * m_i) - (5 * both - ij) * r),
          prefactor * (ij - 3 * both)};
}

/// Pull between two moments that point along the line of centres at contact, 6 m_i m_j/(4 pi d^4):
/// F0/8 for two equal spheres of radius a = d/2, F0 = 3 mu* m^2/(4 pi a^4).
inline double contact_pull(double m_i, double m_j, double contact_distance) {
  const double d2 = contact_distance * contact_distance;
  return 1.5 * m_i * m_j / (std::numbers::pi * d2 * d2);
}

/// Where the soft repulsion has fallen to 2e-16 of the contact pull, a rounding: from there on it
/// need not be computed.
inline double soft_reach(double kappa, double d) { return d * (1 + 36 / kappa); }

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

/// Load on a joint inside a long straight chain over the pull of a touching pair: every pair that
/// spans the joint pulls, n of them at n times the distance, so that it is sum n/n^4 = zeta(3).
inline constexpr double chain_load = 1.2020569031595942;

/// Stiffness of a joint that the soft repulsion holds under the load of a long chain: kappa load/d,
/// less the slope 4 pull/d of the dipoles, which pull the harder the nearer they are.
inline double soft_stiffness(double pull, double kappa, double d) {
  return (chain_load * kappa - 4) * pull / d;
}

/// The same of Eq. 26: F ~ epsilon sigma^12/s^13, so 13 F/s where F is the load.
inline double paper_stiffness(double pull, double epsilon, double sigma) {
  const double load = chain_load * pull;
  if (!(load > 0)) return 13 * epsilon / (sigma * sigma);
  return 13 * load / (sigma * std::pow(epsilon / (load * sigma), 1.0 / 13));
}

/// Sub-steps of a time step in which explicit steps of touching chains are stable. The stiffest
/// mode has the rate 4 k dt/Gamma, and a sub-step is stable below 2 of it. In a single one a rate
/// above 1 would make contacts swing back in every step, in time with the fluid, which answers the
/// forces of the step before with the rest of the carriers' mobility: then there are two.
/// @param rate  k dt/Gamma
inline double contact_substeps(double rate) {
  return std::max(rate > 0.25 ? 2.0 : 1.0, std::ceil(2 * rate));
}

/// Pull of an aligned pair at the distance of a cut-off, over that at contact: what the cut-off
/// neglects of one pair at most.
inline double neglected_pull(double d, double cutoff) { return std::pow(d / cutoff, 4); }

}  // namespace hemomag::magnetic
