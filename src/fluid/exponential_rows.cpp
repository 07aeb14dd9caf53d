// Compiled once per instruction set (hemo_simd): the exponential scheme's rows behind
// fluid/sweep.hpp.
#include "fluid/exponential.hpp"

#include "fluid/row_sweep.hpp"
#include "fluid/sweep_rows.hpp"

namespace hemomag::fluid::HEMOMAG_SIMD {
namespace {

template <class Real>
[[gnu::always_inline]] inline Moments<typename Simd<Real>::Vector>
load_moments(const Real* const* field, std::ptrdiff_t at) {
  return {load(field[0] + at), load(field[1] + at), load(field[2] + at), load(field[3] + at),
          load(field[4] + at), load(field[5] + at), load(field[6] + at)};
}

template <Pass pass, bool solid, class Real>
[[gnu::always_inline]] inline void exponential(const SweepFields<Real>& s, const Relaxation& r) {
  using Vector = typename Simd<Real>::Vector;
  const double tau_ = r.tau, E_ = __builtin_exp(-1 / tau_), D_ = 1 - (1 - E_) * tau_,
               K_ = 0.5 - D_ * (tau_ + 0.5);
  const Real tau = static_cast<Real>(tau_), E = static_cast<Real>(E_),
             one_E = static_cast<Real>(1 - E_), D = static_cast<Real>(D_),
             D_K = static_cast<Real>(D_ - K_), K = static_cast<Real>(K_);
  constexpr Real third = Real(1.0 / 3);
  std::ptrdiff_t towards[19];
  for (int i = 0; i < 19; ++i) towards[i] = ex[i] + ey[i] * s.f_row + ez[i] * s.f_plane;
  sweep_rows<pass, solid>(
      s, r.force,
      [&](std::ptrdiff_t at, std::ptrdiff_t node, Vector(&g)[19], const Vector(&F)[3], auto wet)
          __attribute__((always_inline)) {
            const Source<Vector, Real> last(load_moments(s.last, at), tau);
            {
              const Real* const before[moments] = {s.present[0], s.present[1], s.present[2],
                                                   s.present[3], s.present[4], s.present[5],
                                                   s.present[6]};
              const Source<Vector, Real> earlier(load_moments(before, at), tau);
              g[0] += third * (D * last.rest - K * earlier.rest);
              for_each_pair<Real>([&](int a, int b, Real w, auto c) __attribute__((always_inline)) {
                const Source<Vector, Real> ahead(load_moments(s.last, at + towards[a]), tau);
                const Source<Vector, Real> behind(load_moments(s.last, at + towards[b]), tau);
                const auto even = [&](const Source<Vector, Real>& q) {
                  return q.even(w, c(q.ux, q.uy, q.uz), c(q.qx, q.qy, q.qz));
                };
                const auto odd = [&](const Source<Vector, Real>& q) {
                  return q.odd(w, c(q.jx, q.jy, q.jz));
                };
                const Vector both = D_K * even(last) - K * even(earlier);
                const Vector sense = D_K * odd(last) - K * odd(earlier);
                g[a] += both + sense + K * (even(ahead) + odd(ahead));
                g[b] += both - sense + K * (even(behind) - odd(behind));
              });
            }
            if constexpr (solid)
              for (int i = 0; i < 19; ++i) g[i] = wet(g[i]);

            const Vector drho =
                ((g[0] + (g[1] + g[2])) + ((g[3] + g[4]) + (g[5] + g[6]))) +
                (((g[7] + g[8]) + (g[9] + g[10])) + ((g[11] + g[12]) + (g[13] + g[14]))) +
                ((g[15] + g[16]) + (g[17] + g[18]));
            const Vector per_rho = Real(1) / (drho + Real(1));
            const Vector ux = per_rho * ((g[1] - g[2]) + ((g[7] - g[10]) + (g[8] - g[9])) +
                                         ((g[11] - g[14]) - (g[12] - g[13])));
            const Vector uy = per_rho * ((g[3] - g[4]) + ((g[7] - g[10]) - (g[8] - g[9])) +
                                         ((g[15] - g[18]) + (g[16] - g[17])));
            const Vector uz = per_rho * ((g[5] - g[6]) + ((g[11] - g[14]) + (g[12] - g[13])) +
                                         ((g[15] - g[18]) - (g[16] - g[17])));
            const Moments<Vector> m{drho, ux, uy, uz, F[0], F[1], F[2]};
            store(s.u[0] + node, ux), store(s.u[1] + node, uy), store(s.u[2] + node, uz);
            store(s.present[0] + at, drho);
            store(s.present[1] + at, ux), store(s.present[2] + at, uy);
            store(s.present[3] + at, uz);
            store(s.present[4] + at, F[0]), store(s.present[5] + at, F[1]);
            store(s.present[6] + at, F[2]);

            const Source<Vector, Real> now(m, tau);
            g[0] = E * g[0] + third * (one_E * now.rest - D_K * last.rest);
            for_each_pair<Real>([&](int a, int b, Real w, auto c) __attribute__((always_inline)) {
              const Vector both =
                  one_E * now.even(w, c(now.ux, now.uy, now.uz), c(now.qx, now.qy, now.qz)) -
                  D_K * last.even(w, c(last.ux, last.uy, last.uz), c(last.qx, last.qy, last.qz));
              const Vector sense = one_E * now.odd(w, c(now.jx, now.jy, now.jz)) -
                                   D_K * last.odd(w, c(last.jx, last.jy, last.jz));
              g[a] = E * g[a] + both + sense;
              g[b] = E * g[b] + both - sense;
            });
          },
      [&](std::ptrdiff_t at) {
        for (int m = 0; m < moments; ++m) wrap_ghosts(s.present[m] + at, s.wrap_x, 1);
      });
}

template <class Real>
[[gnu::always_inline]] inline void choose(Pass pass, const SweepFields<Real>& s,
                                          const Relaxation& r) {
  if (s.distance)
    pass == Pass::local ? exponential<Pass::local, true>(s, r)
                        : exponential<Pass::shift, true>(s, r);
  else
    pass == Pass::local ? exponential<Pass::local, false>(s, r)
                        : exponential<Pass::shift, false>(s, r);
}

}  // namespace

void sweep_exponential(Pass pass, const SweepFields<double>& fields, const Relaxation& r) {
  choose(pass, fields, r);
}
void sweep_exponential(Pass pass, const SweepFields<float>& fields, const Relaxation& r) {
  choose(pass, fields, r);
}

}  // namespace hemomag::fluid::HEMOMAG_SIMD
