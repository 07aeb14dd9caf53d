#pragma once
#include <array>

#include "fluid/relaxation.hpp"
#include "fluid/sweep.hpp"

// One site of the exponential scheme (the paper's Eqs. 8-11, corrected: fluid/relaxation.hpp). The
// distribution g_i = f_i^eq + tau F_i of a node is linear in ten numbers, so that these are kept,
// for two time levels, instead of nineteen, and the populations stream in place. With
//
//   h_i(x, t)   = E f_i + (1 - E) g_i(t) + (K - D) g_i(t-1)                  streams to x + e_i
//   f_i(x, t+1) = h_i(x - e_i, t) + (D - K) g_i(x, t) - K g_i(x, t-1) + K g_i(x + e_i, t)
//
// F_i is the source of Guo, Zheng & Shi (Eq. 7) without the factor 1 - 1/(2 tau). f is the true
// distribution at its time: rho u = sum e_i f_i, without half the force (differs from Eq. 12).

namespace hemomag::fluid {

/// The ten numbers of a node. With j = rho u + tau F and q = j + tau F
///   g_i - w_i = w_i [r + 3 e_i.j + 4.5 (e_i.u)(e_i.q)],   r = rho - 1 - 1.5 u.q,
/// held as r, 3 j, and the products so scaled that the last term is xx for e_i along x and
/// xx + yy +- xy for e_i in the x-y plane. T is a number or a SIMD vector.
template <class T> struct Source {
  T value[sources];

  [[gnu::always_inline]] T r() const { return value[0]; }
  [[gnu::always_inline]] T j(int d) const { return value[1 + d]; }
  [[gnu::always_inline]] T square(int d) const { return value[4 + d]; }
  /// xy, xz, yz: the plane whose number is the sum of its axes less one
  [[gnu::always_inline]] T mixed(int plane) const { return value[7 + plane]; }
  /// rho - 1 = sum_i (g_i - w_i)
  template <class R> [[gnu::always_inline]] T drho() const {
    return r() + R(1.0 / 3) * (square(0) + square(1) + square(2));
  }
};

template <class T, class R>
[[gnu::always_inline]] inline Source<T> source(const T& drho, const T (&u)[3], const T (&F)[3],
                                               R tau) {
  const T rho = drho + R(1);
  T j[3], q[3];
  for (int d = 0; d < 3; ++d) {
    j[d] = rho * u[d] + tau * F[d];
    q[d] = j[d] + tau * F[d];
  }
  const T xx = R(4.5) * u[0] * q[0], yy = R(4.5) * u[1] * q[1], zz = R(4.5) * u[2] * q[2];
  return {{drho - R(1.0 / 3) * (xx + yy + zz), R(3) * j[0], R(3) * j[1], R(3) * j[2], xx, yy, zz,
           R(4.5) * (u[0] * q[1] + u[1] * q[0]), R(4.5) * (u[0] * q[2] + u[2] * q[0]),
           R(4.5) * (u[1] * q[2] + u[2] * q[1])}};
}

/// Along an axis d: (g_i + g_-i)/2 - w_i = w_i even, (g_i - g_-i)/2 = w_i odd.
struct AxisPair {
  int d;
  template <class S> [[gnu::always_inline]] auto even(const S& s) const {
    return s.r() + s.square(d);
  }
  template <class S> [[gnu::always_inline]] auto odd(const S& s) const { return s.j(d); }
};

/// Along e_a + e_b, or e_a - e_b.
template <bool plus> struct DiagonalPair {
  int a, b;
  template <class S> [[gnu::always_inline]] auto even(const S& s) const {
    const auto straight = s.r() + (s.square(a) + s.square(b));
    return plus ? straight + s.mixed(a + b - 1) : straight - s.mixed(a + b - 1);
  }
  template <class S> [[gnu::always_inline]] auto odd(const S& s) const {
    return plus ? s.j(a) + s.j(b) : s.j(a) - s.j(b);
  }
};

/// Visit the nine pairs of opposite directions: visit(i, opposite of i, weight, pair).
template <class R, class Visit> [[gnu::always_inline]] inline void for_each_pair(Visit visit) {
  const R axis = R(1.0 / 18), diagonal = R(1.0 / 36);
  visit(1, 2, axis, AxisPair{0});
  visit(3, 4, axis, AxisPair{1});
  visit(5, 6, axis, AxisPair{2});
  visit(7, 10, diagonal, DiagonalPair<true>{0, 1});
  visit(8, 9, diagonal, DiagonalPair<false>{0, 1});
  visit(11, 14, diagonal, DiagonalPair<true>{0, 2});
  visit(13, 12, diagonal, DiagonalPair<false>{0, 2});
  visit(15, 18, diagonal, DiagonalPair<true>{1, 2});
  visit(16, 17, diagonal, DiagonalPair<false>{1, 2});
}

}  // namespace hemomag::fluid
