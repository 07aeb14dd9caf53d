#pragma once

namespace hemomag::contact {

/// Lennard-Jones repulsion (Eq. 40) cut at its minimum 2^(1/6) sigma and shifted to zero there.
struct LennardJones {
  double epsilon = 0;
  double sigma = 0;
};

inline constexpr double lj_cutoff_over_sigma = 1.122462048309373;  // 2^(1/6)

/// -dU/dr over r, from r^2 < (2^(1/6) sigma)^2.
inline double force_over_r(const LennardJones& lj, double r2) {
  const double q = lj.sigma * lj.sigma / r2, q6 = q * q * q;
  return 24 * lj.epsilon * (2 * q6 * q6 - q6) / r2;
}

inline double energy(const LennardJones& lj, double r2) {
  const double q = lj.sigma * lj.sigma / r2, q6 = q * q * q;
  return 4 * lj.epsilon * (q6 * q6 - q6) + lj.epsilon;
}

}  // namespace hemomag::contact
