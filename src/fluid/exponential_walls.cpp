#include "fluid/exponential_walls.hpp"

#include "fluid/exponential.hpp"
#include "lattice/d3q19.hpp"

namespace hemomag::fluid {
namespace {

using namespace lattice::d3q19;

Vec3 direction(int i) {
  const auto& c = e[static_cast<std::size_t>(i)];
  return {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
}

/// Where the sweep will read f_i of the node at offset 0.
template <class Real>
Real* place(Pass next, int i, const Populations<Real>& f, const lattice::NodeLayout& layout) {
  const auto k = static_cast<std::size_t>(i);
  if (next == Pass::local) return f[k];
  return f[static_cast<std::size_t>(opposite[k])] - layout.index(e[k][0], e[k][1], e[k][2]);
}

/// The part of 2 K g_j e_i that the weights make up, with the opposite sign, for one link.
double at_rest(int i, const ExponentialRates& rates) {
  return 2 * rates.K * w[static_cast<std::size_t>(i)];
}

}  // namespace

template <class Real>
Real source_population(const MomentFields<Real>& field, std::ptrdiff_t at, int i, Real tau) {
  const Source<Real, Real> s({field[0][at], field[1][at], field[2][at], field[3][at], field[4][at],
                              field[5][at], field[6][at]},
                             tau);
  const auto k = static_cast<std::size_t>(i);
  const Real x = static_cast<Real>(e[k][0]), y = static_cast<Real>(e[k][1]),
             z = static_cast<Real>(e[k][2]);
  const auto along = [&](Real a, Real b, Real c) { return x * a + y * b + z * c; };
  const Real weight = static_cast<Real>(w[k]);
  return s.even(weight, along(s.ux, s.uy, s.uz), along(s.qx, s.qy, s.qz)) +
         s.odd(weight, along(s.jx, s.jy, s.jz));
}

template <class Real>
Vec3 add_reflected_source(const Plate& plate, Pass next, const Populations<Real>& f,
                          const MomentFields<Real>& last, const lattice::NodeLayout& layout,
                          const ExponentialRates& rates, int sense) {
  const Real K = static_cast<Real>(sense * rates.K), tau = static_cast<Real>(rates.tau);
  Vec3 given;
  for (const int i : crossing(plate.axis, plate.side == Side::low ? -1 : 1)) {
    const int j = opposite[static_cast<std::size_t>(i)];
    const Real push =
        static_cast<Real>(6 * w[static_cast<std::size_t>(i)] * dot(direction(i), plate.velocity));
    Real* const target = place(next, i, f, layout);
    double sum = 0;
    for_each_row(first_layer(plate, layout), layout, [&](std::ptrdiff_t row, int n) {
      Real row_sum = 0;
      for (int x = 0; x < n; ++x) {
        const Real g = source_population(last, row + x, j, tau);
        target[row + x] += K * (g + push);
        row_sum += g;
      }
      sum += rates.K * (2.0 * row_sum + n * push) + n * at_rest(i, rates);
    });
    given -= sum * direction(i);
  }
  return given;
}

template <class Real>
Vec3 add_reflected_source(const WallLinks<Real>& links, Pass next, const Populations<Real>& f,
                          const MomentFields<Real>& last, const lattice::NodeLayout& layout,
                          const ExponentialRates& rates, int sense) {
  const Real K = static_cast<Real>(sense * rates.K), tau = static_cast<Real>(rates.tau);
  Vec3 given;
  links.for_each([&](int i, std::ptrdiff_t x) {
    const Real g = source_population(last, x, opposite[static_cast<std::size_t>(i)], tau);
    place(next, i, f, layout)[x] += K * g;
    given -= (2 * rates.K * g + at_rest(i, rates)) * direction(i);
  });
  return given;
}

#define HEMOMAG_INSTANTIATE(Real)                                                                  \
  template Real source_population(const MomentFields<Real>&, std::ptrdiff_t, int, Real);           \
  template Vec3 add_reflected_source(const Plate&, Pass, const Populations<Real>&,                 \
                                     const MomentFields<Real>&, const lattice::NodeLayout&,        \
                                     const ExponentialRates&, int);                                \
  template Vec3 add_reflected_source(const WallLinks<Real>&, Pass, const Populations<Real>&,       \
                                     const MomentFields<Real>&, const lattice::NodeLayout&,        \
                                     const ExponentialRates&, int);
HEMOMAG_INSTANTIATE(double)
HEMOMAG_INSTANTIATE(float)
#undef HEMOMAG_INSTANTIATE

}  // namespace hemomag::fluid
