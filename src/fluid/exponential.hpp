#pragma once
#include <array>

#include "fluid/relaxation.hpp"

// One site of the exponential scheme (the paper's Eqs. 8-11, corrected: fluid/relaxation.hpp). The
// distribution g_i = f_i^eq + tau F_i of a node follows from its density, velocity and force, so
// only these are kept, for two time levels, and the populations stream in place. With
//
//   h_i(x, t)   = E f_i + (1 - E) g_i(t) + (K - D) g_i(t-1)                  streams to x + e_i
//   f_i(x, t+1) = h_i(x - e_i, t) + (D - K) g_i(x, t) - K g_i(x, t-1) + K g_i(x + e_i, t)
//
// F_i is the source of Guo, Zheng & Shi (Eq. 7) without the factor 1 - 1/(2 tau). f is the true
// distribution at its time: rho u = sum e_i f_i, without half the force (differs from Eq. 12).

namespace hemomag::fluid {

/// What g needs to know of a node. T is a number or a SIMD vector.
template <class T> struct Moments { T drho, ux, uy, uz, Fx, Fy, Fz; };

/// g_i - w_i for pairs of opposite directions, as even and odd parts.
template <class T, class R> struct Source {
  T rest, ux, uy, uz, jx, jy, jz, qx, qy, qz;

  [[gnu::always_inline]] Source(const Moments<T>& m, R tau) {
    const T rho = m.drho + R(1);
    ux = m.ux, uy = m.uy, uz = m.uz;
    jx = rho * ux + tau * m.Fx, jy = rho * uy + tau * m.Fy, jz = rho * uz + tau * m.Fz;
    qx = jx + tau * m.Fx, qy = jy + tau * m.Fy, qz = jz + tau * m.Fz;
    // 1.5 rho u.u + 3 tau u.F = 1.5 u.q
    rest = m.drho - R(1.5) * (ux * qx + uy * qy + uz * qz);
  }
  /// Direction c with weight w: g_c - w = even + odd, g_-c - w = even - odd.
  [[gnu::always_inline]] T even(R w, T c_u, T c_q) const { return w * (rest + R(4.5) * c_u * c_q); }
  [[gnu::always_inline]] T odd(R w, T c_j) const { return R(3) * w * c_j; }
};

/// Visit the nine pairs of opposite directions: visit(a, b, weight, project) where project(x, y, z)
/// is e_a . (x, y, z).
template <class R, class Visit> [[gnu::always_inline]] inline void for_each_pair(Visit visit) {
  const R axis = R(1.0 / 18), diagonal = R(1.0 / 36);
  visit(1, 2, axis, [](auto x, auto, auto) { return x; });
  visit(3, 4, axis, [](auto, auto y, auto) { return y; });
  visit(5, 6, axis, [](auto, auto, auto z) { return z; });
  visit(7, 10, diagonal, [](auto x, auto y, auto) { return x + y; });
  visit(8, 9, diagonal, [](auto x, auto y, auto) { return x - y; });
  visit(11, 14, diagonal, [](auto x, auto, auto z) { return x + z; });
  visit(13, 12, diagonal, [](auto x, auto, auto z) { return x - z; });
  visit(15, 18, diagonal, [](auto, auto y, auto z) { return y + z; });
  visit(16, 17, diagonal, [](auto, auto y, auto z) { return y - z; });
}

}  // namespace hemomag::fluid
