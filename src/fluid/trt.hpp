#pragma once
#include <array>

// One site of the two-relaxation-time collision with Guo forcing. Populations are stored as f_i -
// w_i, so that a small velocity does not drown in the rounding of the weights.

namespace hemomag::fluid {

/// Relaxation rates as the collision uses them.
template <class T> struct TrtRates {
  T omega_plus;    ///< 1/tau, even part
  T omega_minus;   ///< odd part
  T source_plus;   ///< 1 - omega_plus/2
  T source_minus;  ///< 1 - omega_minus/2
};

/// x/12, with the constant in two parts: 1/12 is not a number of base two, and in single precision
/// its rounding alone would create or destroy 3e-8 of the momentum in every step, always with the
/// same sign, which bends a shear profile.
template <class R, class T> [[gnu::always_inline]] inline T twelfth(const T& x) {
  constexpr R high = R(1.0 / 12);
  constexpr R low = R(1.0L / 12 - static_cast<long double>(high));
  return x * high + x * low;
}

/// Collide one site in place: f_i* = f_i + omega+ (f_i^eq+ - f_i^+) + omega- (f_i^eq- - f_i^-) +
/// S_i (Ginzburg, Verhaeghe & d'Humieres, Commun. Comput. Phys. 3:427, 2008, with the force of Guo,
/// Zheng & Shi, Phys. Rev. E 65:046308, 2002, whose even and odd parts carry 1 - omega+/2 and 1 -
/// omega-/2). Equilibrium: Eq. 5; moments: Eq. 12, rho u = sum e_i f_i + F/2.
/// @param g  populations f_i - w_i in the order of d3q19; on return the post-collision ones
/// @param F  force density
/// @return   velocity u
/// T is a number or a SIMD vector of numbers. Conserves mass exactly and adds F to the momentum.
template <class T, class R>
[[gnu::always_inline]] inline std::array<T, 3> collide_trt(T (&g)[19], const T (&F)[3],
                                                           const TrtRates<R>& rate) {
  const T drho = ((g[0] + (g[1] + g[2])) + ((g[3] + g[4]) + (g[5] + g[6]))) +
                 (((g[7] + g[8]) + (g[9] + g[10])) + ((g[11] + g[12]) + (g[13] + g[14]))) +
                 ((g[15] + g[16]) + (g[17] + g[18]));
  const R half = R(0.5);
  const T px =
      ((g[1] - g[2]) + ((g[7] - g[10]) + (g[8] - g[9])) + ((g[11] - g[14]) - (g[12] - g[13]))) +
      half * F[0];
  const T py =
      ((g[3] - g[4]) + ((g[7] - g[10]) - (g[8] - g[9])) + ((g[15] - g[18]) + (g[16] - g[17]))) +
      half * F[1];
  const T pz =
      ((g[5] - g[6]) + ((g[11] - g[14]) + (g[12] - g[13])) + ((g[15] - g[18]) - (g[16] - g[17]))) +
      half * F[2];
  const T rho = drho + R(1);
  const T per_rho = R(1) / rho;
  const T ux = px * per_rho, uy = py * per_rho, uz = pz * per_rho;

  const T u2 = R(1.5) * (ux * ux + uy * uy + uz * uz);
  const T uF = R(3) * (ux * F[0] + uy * F[1] + uz * F[2]);
  const T rest = drho - rho * u2;
  g[0] += rate.omega_plus * (R(1.0 / 3) * rest - g[0]) - rate.source_plus * R(1.0 / 3) * uF;

  // 3 w_i e_i . p is p/12 along a diagonal and twice that along an axis.
  const T odd_x[2] = {twelfth<R>(px), twelfth<R>(F[0])};
  const T odd_y[2] = {twelfth<R>(py), twelfth<R>(F[1])};
  const T odd_z[2] = {twelfth<R>(pz), twelfth<R>(F[2])};
  const auto pair = [&](T & a, T & b, R weight, T c_u, T c_F, T odd_eq, T odd_source)
      __attribute__((always_inline)) {
    const T even_eq = weight * (rest + R(4.5) * rho * c_u * c_u);
    const T even_source = weight * (R(9) * c_u * c_F - uF);
    const T even = rate.omega_plus * (even_eq - half * (a + b)) + rate.source_plus * even_source;
    const T odd = rate.omega_minus * (odd_eq - half * (a - b)) + rate.source_minus * odd_source;
    a += even + odd;
    b += even - odd;
  };
  const R axis = R(1.0 / 18), diagonal = R(1.0 / 36);
  pair(g[1], g[2], axis, ux, F[0], R(2) * odd_x[0], R(2) * odd_x[1]);
  pair(g[3], g[4], axis, uy, F[1], R(2) * odd_y[0], R(2) * odd_y[1]);
  pair(g[5], g[6], axis, uz, F[2], R(2) * odd_z[0], R(2) * odd_z[1]);
  pair(g[7], g[10], diagonal, ux + uy, F[0] + F[1], odd_x[0] + odd_y[0], odd_x[1] + odd_y[1]);
  pair(g[8], g[9], diagonal, ux - uy, F[0] - F[1], odd_x[0] - odd_y[0], odd_x[1] - odd_y[1]);
  pair(g[11], g[14], diagonal, ux + uz, F[0] + F[2], odd_x[0] + odd_z[0], odd_x[1] + odd_z[1]);
  pair(g[13], g[12], diagonal, ux - uz, F[0] - F[2], odd_x[0] - odd_z[0], odd_x[1] - odd_z[1]);
  pair(g[15], g[18], diagonal, uy + uz, F[1] + F[2], odd_y[0] + odd_z[0], odd_y[1] + odd_z[1]);
  pair(g[16], g[17], diagonal, uy - uz, F[1] - F[2], odd_y[0] - odd_z[0], odd_y[1] - odd_z[1]);
  return {ux, uy, uz};
}

}  // namespace hemomag::fluid
