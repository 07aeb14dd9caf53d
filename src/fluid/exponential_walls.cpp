#include "fluid/exponential_walls.hpp"

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

/// The fields, with their signs, that make up g_i - w_i over w_i: three along an axis, six along a
/// diagonal.
template <class Real, int terms> struct Combination {
  const Real* field[terms];
  Real sign[terms];

  Combination(const SourceNumbers<Real>& fields, int i) {
    const auto& c = e[static_cast<std::size_t>(i)];
    int n = 0;
    const auto add = [&](int k, int s) {
      field[n] = fields[static_cast<std::size_t>(k)];
      sign[n++] = static_cast<Real>(s);
    };
    add(0, 1);
    for (int d = 0; d < 3; ++d)
      if (c[d] != 0) add(1 + d, c[d]), add(4 + d, 1);
    for (int a = 0; a < 3; ++a)
      for (int b = a + 1; b < 3; ++b)
        if (c[a] * c[b] != 0) add(6 + a + b, c[a] * c[b]);
  }
  Real operator()(std::ptrdiff_t at) const {
    Real sum = 0;
    for (int t = 0; t < terms; ++t) sum += sign[t] * field[t][at];
    return sum;
  }
};

/// K (g + push) onto a row of n nodes. @return sum of g
template <int terms, class Real>
Real reflect_row(const Combination<Real, terms>& g_over_w, Real w_j, Real K, Real push,
                 std::ptrdiff_t row, int n, Real* target) {
  Real sum = 0;
  for (std::ptrdiff_t x = row; x < row + n; ++x) {
    const Real g = w_j * g_over_w(x);
    target[x] += K * (g + push);
    sum += g;
  }
  return sum;
}

}  // namespace

template <class Real>
Real source_population(const SourceNumbers<Real>& field, std::ptrdiff_t at, int i) {
  const Real w_i = static_cast<Real>(w[static_cast<std::size_t>(i)]);
  if (i == 0) return w_i * field[0][at];
  return w_i * (i < 7 ? Combination<Real, 3>(field, i)(at) : Combination<Real, 6>(field, i)(at));
}

template <class Real>
Vec3 add_reflected_source(const Plate& plate, Pass next, const Populations<Real>& f,
                          const SourceNumbers<Real>& last, const lattice::NodeLayout& layout,
                          const ExponentialRates& rates, int sense) {
  const Real K = static_cast<Real>(sense * rates.K);
  Vec3 given;
  for (const int i : crossing(plate.axis, plate.side == Side::low ? -1 : 1)) {
    const int j = opposite[static_cast<std::size_t>(i)];
    const Real push =
        static_cast<Real>(6 * w[static_cast<std::size_t>(i)] * dot(direction(i), plate.velocity));
    const Real w_j = static_cast<Real>(w[static_cast<std::size_t>(j)]);
    Real* const target = place(next, i, f, layout);
    double sum = 0;
    for_each_row(first_layer(plate, layout), layout, [&](std::ptrdiff_t row, int n) {
      const Real row_sum =
          i < 7 ? reflect_row(Combination<Real, 3>(last, j), w_j, K, push, row, n, target)
                : reflect_row(Combination<Real, 6>(last, j), w_j, K, push, row, n, target);
      sum += rates.K * (2.0 * row_sum + static_cast<Real>(n) * push) + n * at_rest(i, rates);
    });
    given -= sum * direction(i);
  }
  return given;
}

template <class Real>
Vec3 add_reflected_source(const WallLinks<Real>& links, Pass next, const Populations<Real>& f,
                          const SourceNumbers<Real>& last, const lattice::NodeLayout& layout,
                          const ExponentialRates& rates, int sense) {
  const Real K = static_cast<Real>(sense * rates.K);
  Vec3 given;
  links.for_each([&](int i, std::ptrdiff_t x) {
    const Real g = source_population(last, x, opposite[static_cast<std::size_t>(i)]);
    place(next, i, f, layout)[x] += K * g;
    given -= (2 * rates.K * g + at_rest(i, rates)) * direction(i);
  });
  return given;
}

#define HEMOMAG_INSTANTIATE(Real)                                                                  \
  template Real source_population(const SourceNumbers<Real>&, std::ptrdiff_t, int);                \
  template Vec3 add_reflected_source(const Plate&, Pass, const Populations<Real>&,                 \
                                     const SourceNumbers<Real>&, const lattice::NodeLayout&,       \
                                     const ExponentialRates&, int);                                \
  template Vec3 add_reflected_source(const WallLinks<Real>&, Pass, const Populations<Real>&,       \
                                     const SourceNumbers<Real>&, const lattice::NodeLayout&,       \
                                     const ExponentialRates&, int);
HEMOMAG_INSTANTIATE(double)
HEMOMAG_INSTANTIATE(float)
#undef HEMOMAG_INSTANTIATE

}  // namespace hemomag::fluid
