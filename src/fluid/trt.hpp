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
  const T jx =
      (g[1] - g[2]) + ((g[7] - g[10]) + (g[8] - g[9])) + ((g[11] - g[14]) - (g[12] - g[13]));
  const T jy =
      (g[3] - g[4]) + ((g[7] - g[10]) - (g[8] - g[9])) + ((g[15] - g[18]) + (g[16] - g[17]));
  const T jz =
      (g[5] - g[6]) + ((g[11] - g[14]) + (g[12] - g[13])) + ((g[15] - g[18]) - (g[16] - g[17]));
  const T rho = drho + R(1);
  const T per_rho = R(1) / rho;
  const T ux = (jx + half * F[0]) * per_rho;
  const T uy = (jy + half * F[1]) * per_rho;
  const T uz = (jz + half * F[2]) * per_rho;

  const T u2 = R(1.5) * (ux * ux + uy * uy + uz * uz);
  const T uF = R(3) * (ux * F[0] + uy * F[1] + uz * F[2]);
  const T rest = drho - rho * u2;
  g[0] += rate.omega_plus * (R(1.0 / 3) * rest - g[0]) - rate.source_plus * R(1.0 / 3) * uF;

  const auto pair = [&](T & a, T & b, R weight, T c_u, T c_F) __attribute__((always_inline)) {
    const T even_eq = weight * (rest + R(4.5) * rho * c_u * c_u);
    const T odd_eq = R(3) * weight * rho * c_u;
    const T even_source = weight * (R(9) * c_u * c_F - uF);
    const T odd_source = R(3) * weight * c_F;
    const T even = rate.omega_plus * (even_eq - half * (a + b)) + rate.source_plus * even_source;
    const T odd = rate.omega_minus * (odd_eq - half * (a - b)) + rate.source_minus * odd_source;
    a += even + odd;
    b += even - odd;
  };
  const R axis = R(1.0 / 18), diagonal = R(1.0 / 36);
  pair(g[1], g[2], axis, ux, F[0]);
  pair(g[3], g[4], axis, uy, F[1]);
  pair(g[5], g[6], axis, uz, F[2]);
  pair(g[7], g[10], diagonal, ux + uy, F[0] + F[1]);
  pair(g[8], g[9], diagonal, ux - uy, F[0] - F[1]);
  pair(g[11], g[14], diagonal, ux + uz, F[0] + F[2]);
  pair(g[13], g[12], diagonal, ux - uz, F[0] - F[2]);
  pair(g[15], g[18], diagonal, uy + uz, F[1] + F[2]);
  pair(g[16], g[17], diagonal, uy - uz, F[1] - F[2]);
  return {ux, uy, uz};
}

}  // namespace hemomag::fluid
