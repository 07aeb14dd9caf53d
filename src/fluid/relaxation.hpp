#pragma once

namespace hemomag::fluid {

/// What one collision needs to know, in lattice units (dx = dt = 1).
struct Relaxation {
  double tau;    ///< relaxation time of the even moments, nu = (tau - 1/2)/3     > 1/2
  double magic;  ///< Lambda = (tau - 1/2)(tau_minus - 1/2); 3/16 puts half-way walls exactly there
                 ///< > 0
  double force[3] = {};  ///< uniform body force density

  /// The single relaxation time of BGK: both rates 1/tau. Walls then lie off half-way by an amount
  /// that grows with tau.
  static Relaxation bgk(double tau) { return {tau, (tau - 0.5) * (tau - 0.5)}; }

  double viscosity() const { return (tau - 0.5) / 3.0; }
  double omega_plus() const { return 1.0 / tau; }
  double omega_minus() const { return 1.0 / (0.5 + magic / (tau - 0.5)); }
};

}  // namespace hemomag::fluid
