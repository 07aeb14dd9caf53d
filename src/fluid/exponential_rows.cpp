// Compiled once per instruction set (hemo_simd): the exponential scheme's rows behind
// fluid/sweep.hpp.
#include "fluid/exponential.hpp"

#include "fluid/row_sweep.hpp"
#include "fluid/sweep_rows.hpp"

namespace hemomag::fluid::HEMOMAG_SIMD {
namespace {

/// The ten numbers of other nodes, loaded when they are asked for.
template <class Real> struct SourceAt {
  const Real* const* field;
  std::ptrdiff_t at;
  [[gnu::always_inline]] auto value(int k) const { return load(field[k] + at); }
  [[gnu::always_inline]] auto r() const { return value(0); }
  [[gnu::always_inline]] auto j(int d) const { return value(1 + d); }
  [[gnu::always_inline]] auto square(int d) const { return value(4 + d); }
  [[gnu::always_inline]] auto mixed(int plane) const { return value(7 + plane); }
};

/// a s + b t, number by number.
template <class Real, class S, class T>
[[gnu::always_inline]] inline Source<typename Simd<Real>::Vector> combine(Real a, const S& s,
                                                                          Real b, const T& t) {
  Source<typename Simd<Real>::Vector> sum;
#pragma GCC unroll 10
  for (int k = 0; k < sources; ++k) sum.value[k] = a * s(k) + b * t(k);
  return sum;
}

/// Ask for what the sweep will touch first twelve cache lines ahead. The processor's own prefetch
/// does not follow 45 streams at once: without this the sweep takes 36 ns a node instead of 20.
template <Pass pass, class Real>
[[gnu::always_inline]] inline void prefetch_ahead(const SweepFields<Real>& s,
                                                  const std::ptrdiff_t (&towards)[19],
                                                  std::ptrdiff_t at, std::ptrdiff_t node) {
  constexpr std::ptrdiff_t line = 64 / static_cast<std::ptrdiff_t>(sizeof(Real)), ahead = 12 * line;
  constexpr int read = 0, second_level = 2;
  const std::ptrdiff_t newest = s.f_row + s.f_plane;  // the row of `last` not touched before
#pragma GCC unroll 10
  for (int k = 0; k < sources; ++k) {
    __builtin_prefetch(s.last[k] + at + newest + ahead, read, second_level);
    __builtin_prefetch(s.present[k] + at + ahead, read, second_level);
  }
#pragma GCC unroll 19
  for (int i = 0; i < 19; ++i)
    __builtin_prefetch(s.f[i] + at + (pass == Pass::local ? 0 : towards[i]) + ahead, read,
                       second_level);
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    __builtin_prefetch(s.force[d] + node + ahead, read, second_level);
    __builtin_prefetch(s.u[d] + node + ahead, read, second_level);
  }
}

template <Pass pass, bool solid, class Real>
[[gnu::always_inline]] inline void exponential(const SweepFields<Real>& s, const Relaxation& r) {
  using Vector = typename Simd<Real>::Vector;
  const double tau_ = r.tau, E_ = __builtin_exp(-1 / tau_), D_ = 1 - (1 - E_) * tau_,
               K_ = 0.5 - D_ * (tau_ + 0.5);
  const Real tau = static_cast<Real>(tau_), E = static_cast<Real>(E_),
             one_E = static_cast<Real>(1 - E_), D_K = static_cast<Real>(D_ - K_),
             K = static_cast<Real>(K_);
  constexpr Real third = Real(1.0 / 3);
  std::ptrdiff_t towards[19];
  for (int i = 0; i < 19; ++i) towards[i] = ex[i] + ey[i] * s.f_row + ez[i] * s.f_plane;
  sweep_rows<pass, solid>(
      s, r.force,
      [&](std::ptrdiff_t at, std::ptrdiff_t node, Vector(&g)[19], const Vector(&F)[3],
          auto wet) __attribute__((always_inline)) {
        prefetch_ahead<pass>(s, towards, at, node);
        const auto last = [&](int k) { return load(s.last[k] + at); };
        const auto earlier = [&](int k) { return load(s.present[k] + at); };
        {
          const auto here = combine(D_K, last, -K, earlier);
          g[0] += third * (here.r() + K * last(0));
          for_each_pair<Real>([&](int a, int b, Real w, auto pair) __attribute__((always_inline)) {
            const SourceAt<Real> ahead{s.last, at + towards[a]};
            const SourceAt<Real> behind{s.last, at + towards[b]};
            const Vector even = pair.even(here), odd = pair.odd(here);
            g[a] += w * (even + odd + K * (pair.even(ahead) + pair.odd(ahead)));
            g[b] += w * (even - odd + K * (pair.even(behind) - pair.odd(behind)));
          });
        }
        if constexpr (solid)
          for (int i = 0; i < 19; ++i) g[i] = wet(g[i]);

        const Vector drho =
            ((g[0] + (g[1] + g[2])) + ((g[3] + g[4]) + (g[5] + g[6]))) +
            (((g[7] + g[8]) + (g[9] + g[10])) + ((g[11] + g[12]) + (g[13] + g[14]))) +
            ((g[15] + g[16]) + (g[17] + g[18]));
        const Vector per_rho = Real(1) / (drho + Real(1));
        const Vector u[3] = {per_rho * ((g[1] - g[2]) + ((g[7] - g[10]) + (g[8] - g[9])) +
                                        ((g[11] - g[14]) - (g[12] - g[13]))),
                             per_rho * ((g[3] - g[4]) + ((g[7] - g[10]) - (g[8] - g[9])) +
                                        ((g[15] - g[18]) + (g[16] - g[17]))),
                             per_rho * ((g[5] - g[6]) + ((g[11] - g[14]) + (g[12] - g[13])) +
                                        ((g[15] - g[18]) - (g[16] - g[17])))};
        for (int d = 0; d < 3; ++d) store(s.u[d] + node, u[d]);
        const auto now = source(drho, u, F, tau);
        const auto out = combine(
            one_E, [&](int k) { return now.value[k]; }, -D_K, last);
#pragma GCC unroll 10
        for (int k = 0; k < sources; ++k) store(s.present[k] + at, now.value[k]);

        g[0] = E * g[0] + third * out.r();
        for_each_pair<Real>([&](int a, int b, Real w, auto pair) __attribute__((always_inline)) {
          const Vector even = w * pair.even(out), odd = w * pair.odd(out);
          g[a] = E * g[a] + (even + odd);
          g[b] = E * g[b] + (even - odd);
        });
      },
      [&](std::ptrdiff_t at) {
        for (int k = 0; k < sources; ++k)
          if (s.wrap_x > 0)
            wrap_ghosts(s.present[k] + at, s.wrap_x, 1);
          else  // a ghost in the padding: zero beyond a plate, or about to be received
            s.present[k][at + s.size_x] = Real(0);
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
