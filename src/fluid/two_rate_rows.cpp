// Compiled once per instruction set (hemo_simd): the two-rate rows behind fluid/sweep.hpp.
#include "fluid/sweep_rows.hpp"

#include "fluid/row_sweep.hpp"
#include "fluid/trt.hpp"

namespace hemomag::fluid::HEMOMAG_SIMD {
namespace {

template <Pass pass, bool solid, class Real>
[[gnu::always_inline]] inline void two_rate(const SweepFields<Real>& s, const Relaxation& r) {
  using Vector = typename Simd<Real>::Vector;
  const double plus = 1.0 / r.tau, minus = 1.0 / (0.5 + r.magic / (r.tau - 0.5));
  const TrtRates<Real> rate{static_cast<Real>(plus), static_cast<Real>(minus),
                            static_cast<Real>(1 - 0.5 * plus), static_cast<Real>(1 - 0.5 * minus)};
  sweep_rows<pass, solid>(
      s, r.force,
      [&](std::ptrdiff_t, std::ptrdiff_t node, Vector(&g)[19], const Vector(&F)[3], auto wet)
          __attribute__((always_inline)) {
            if constexpr (solid)
              for (int i = 0; i < 19; ++i) g[i] = wet(g[i]);
            const auto u = collide_trt(g, F, rate);
            for (std::size_t d = 0; d < 3; ++d) store(s.u[d] + node, u[d]);
          },
      [](std::ptrdiff_t) {});
}

template <class Real>
[[gnu::always_inline]] inline void choose(Pass pass, const SweepFields<Real>& s,
                                          const Relaxation& r) {
  if (s.distance)
    pass == Pass::local ? two_rate<Pass::local, true>(s, r) : two_rate<Pass::shift, true>(s, r);
  else
    pass == Pass::local ? two_rate<Pass::local, false>(s, r) : two_rate<Pass::shift, false>(s, r);
}

}  // namespace

void sweep_two_rate(Pass pass, const SweepFields<double>& fields, const Relaxation& r) {
  choose(pass, fields, r);
}
void sweep_two_rate(Pass pass, const SweepFields<float>& fields, const Relaxation& r) {
  choose(pass, fields, r);
}

}  // namespace hemomag::fluid::HEMOMAG_SIMD
