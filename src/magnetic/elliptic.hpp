#pragma once
#include <cmath>
#include <limits>
#include <numbers>

namespace hemomag::magnetic {

/// Bulirsch's complete elliptic integral (Numer. Math. 13:305, 1969), for p > 0:
/// int_0^{pi/2} (a cos^2 + b sin^2)/((cos^2 + p sin^2) sqrt(cos^2 + kc^2 sin^2)).
inline double cel(double kc, double p, double a, double b) {
  constexpr double converged = 1e-8;                            // the error is squared in a turn
  if (kc == 0) return std::numeric_limits<double>::infinity();  // on the ring itself
  double k = kc, kk = kc, em = 1, f = a;
  p = std::sqrt(p);
  b /= p;
  a += b / p;
  double g = k / p;
  b = 2 * (b + f * g);
  p += g;
  g = em;
  em += k;
  while (std::fabs(g - k) > g * converged) {
    k = 2 * std::sqrt(kk);
    kk = k * em;
    f = a;
    a += b / p;
    g = kk / p;
    b = 2 * (b + f * g);
    p += g;
    g = em;
    em += k;
  }
  return 0.5 * std::numbers::pi * (b + a * em) / (em * (em + p));
}

/// Integrals over a ring of radius a seen from (rho, zeta) in its frame, by halves of the angle psi
/// with Delta^2 = cos^2 + kc^2 sin^2 (Jahnke & Emde's B, C, D).
struct RingIntegrals {
  double s;    ///< sqrt((a + rho)^2 + zeta^2), the largest distance
  double k2;   ///< 4 a rho/s^2
  double kc2;  ///< 1 - k2
  double B;    ///< int cos^2/Delta
  double D;    ///< int sin^2/Delta
  double C;    ///< int sin^2 cos^2/Delta^3 = (D - B)/k2

  RingIntegrals(double a, double rho, double zeta) {
    const double far2 = (a + rho) * (a + rho) + zeta * zeta;
    s = std::sqrt(far2);
    k2 = 4 * a * rho / far2;
    kc2 = ((a - rho) * (a - rho) + zeta * zeta) / far2;
    const double kc = std::sqrt(kc2);
    D = cel(kc, 1, 0, 1);
    B = cel(kc, 1, 1, 0);
    C = k2 > 0.1 ? (D - B) / k2 : series(k2);
  }

private:
  /// (pi/16) 2F1(3/2, 3/2; 3; k2): near the axis D - B would lose all digits.
  static double series(double k2) {
    double term = std::numbers::pi / 16, sum = term;
    for (int n = 0; term > 1e-17 * sum; ++n) {
      term *= (n + 1.5) * (n + 1.5) / ((n + 3.0) * (n + 1.0)) * k2;
      sum += term;
    }
    return sum;
  }
};

}  // namespace hemomag::magnetic
