#pragma once
#include <cmath>

namespace hemomag::fluid {

enum class Collision {
  two_rate,     ///< TRT with Guo forcing; BGK is the case of equal rates
  exponential,  ///< the paper's Eqs. 8-11
};

/// What one collision needs to know, in lattice units (dx = dt = 1).
struct Relaxation {
  double tau;    ///< relaxation time of the even moments; two rates: nu = (tau - 1/2)/3, tau > 1/2;
                 ///< exponential: nu = tau/3, tau > 0
  double magic;  ///< Lambda = (tau - 1/2)(tau_minus - 1/2); 3/16 puts half-way walls exactly there
                 ///< > 0; no meaning in the exponential scheme
  double force[3] = {};  ///< uniform body force density
  Collision collision = Collision::two_rate;

  /// The single relaxation time of BGK: both rates 1/tau. Walls then lie off half-way by an amount
  /// that grows with tau.
  static Relaxation bgk(double tau) { return {tau, (tau - 0.5) * (tau - 0.5)}; }
  static Relaxation exponential(double tau) { return {tau, 3.0 / 16, {}, Collision::exponential}; }

  double viscosity() const {
    return collision == Collision::exponential ? tau / 3.0 : (tau - 0.5) / 3.0;
  }
  double omega_plus() const { return 1.0 / tau; }
  double omega_minus() const { return 1.0 / (0.5 + magic / (tau - 0.5)); }
};

/// Coefficients of the exponential scheme (Ollila et al., J. Chem. Phys. 134:064902, 2011):
///
///   f_i(x, t+1) = g_i(x-) + E [f_i(x-) - g_i(x-)] + D [g_i(x, t) - g_i(x-, t-1)]
///               + K [g_i(x+e_i, t) - g_i(x, t-1) - g_i(x, t) + g_i(x-, t-1)],   x- = x - e_i
///
/// Differs from Eqs. 9 and 11: K = 1/2 - D (tau + 1/2), which gives nu = tau/3, and the last term
/// of the second difference lies at x - e_i.
struct ExponentialRates {
  explicit ExponentialRates(double tau)
      : tau(tau), E(std::exp(-1 / tau)), D(1 - (1 - E) * tau), K(0.5 - D * (tau + 0.5)) {}
  double tau, E, D, K;
  /// What a population loses or gains at a moving wall, in units of the two-rate scheme's: the sum
  /// of the coefficients of all that is reflected there.
  double streamed() const { return 1 + K - D; }
};

}  // namespace hemomag::fluid
