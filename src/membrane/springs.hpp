#pragma once
#include <cmath>

namespace hemomag::membrane {

/// In-plane spring of one edge: worm-like chain attraction and power-law repulsion (Eqs. 15, 17,
/// 21). Both constants follow from the shear modulus and from zero force at the edge's own rest
/// length.
/// @tparam T  a number or a SIMD vector of numbers
template <class T> struct SpringOf {
  T l_max = 1;   ///< length at which the chain is fully drawn out
  T wlc = 0;     ///< k_B T / p
  T k_p = 0;     ///< coefficient of the repulsive energy k_p / ((m - 1) l^(m-1)), force k_p / l^m
  double m = 2;  ///< exponent of the repulsive force
};
using Spring = SpringOf<double>;

namespace wlc {
/// Force over k_B T/p at x = l/l_max: 1/(4 (1-x)^2) - 1/4 + x.
template <class T> [[gnu::always_inline]] inline T force(T x) {
  return 0.25 / ((1.0 - x) * (1.0 - x)) - 0.25 + x;
}
/// Energy over k_B T l_max/p: (3 x^2 - 2 x^3)/(4 (1 - x)).
inline double energy(double x) { return 0.25 * x * x * (3 - 2 * x) / (1 - x); }
}  // namespace wlc

/// The spring of rest length x0 l_max whose regular triangular network has the shear modulus mu0:
/// mu0 = sqrt3 k_BT/(4 p l_max x0) [x0/(2 (1-x0)^3) - 1/(4 (1-x0)^2) + 1/4] + sqrt3 (m+1) k_p/(4
/// l0^(m+1))   (Eq. 21) with k_p = (k_BT/p) force(x0) l0^m. The persistence length p = k_BT/wlc is
/// a result, not an input.
/// @param x0 in (0, 1), l_max > 0, mu0 > 0, m > 1
inline Spring make_spring(double x0, double l_max, double mu0, double m) {
  const double l0 = x0 * l_max;
  const double curvature = 0.5 * x0 / std::pow(1 - x0, 3) - 0.25 / ((1 - x0) * (1 - x0)) + 0.25;
  Spring s;
  s.l_max = l_max;
  s.m = m;
  s.wlc = 4 * mu0 * l0 / (std::sqrt(3.0) * (curvature + (m + 1) * wlc::force(x0)));
  s.k_p = s.wlc * wlc::force(x0) * std::pow(l0, m);
  return s;
}

/// Tension of the spring at length l, positive when it pulls its ends together (Eq. 17).
/// Differs from eq. (17): the repulsive force is k_p/l^2, the derivative of Eq. 15, not k_p/l.
template <class T> [[gnu::always_inline]] inline T tension(const SpringOf<T>& s, T l) {
  using std::pow;
  const T power = s.m == 2 ? 1.0 / (l * l) : pow(l, -s.m);
  return s.wlc * wlc::force(l / s.l_max) - s.k_p * power;
}

/// Energy of the spring at length l < l_max (Eq. 15).
inline double energy(const Spring& s, double l) {
  const double power = s.m == 2 ? 1 / l : std::pow(l, 1 - s.m) / (s.m - 1);
  return s.wlc * s.l_max * wlc::energy(l / s.l_max) + s.k_p * power;
}

}  // namespace hemomag::membrane
