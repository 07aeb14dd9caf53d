#include "fluid/sweep.hpp"

#include "fluid/sweep_rows.hpp"
#include "lattice/d3q19.hpp"

namespace hemomag::fluid {
namespace {

template <class Real>
void dispatch(Pass pass, const SweepFields<Real>& fields, const Relaxation& relaxation,
              SimdLevel level) {
  const bool two_rate = relaxation.collision == Collision::two_rate;
  switch (level) {
  case SimdLevel::sse2:
    return two_rate ? sse2::sweep_two_rate(pass, fields, relaxation)
                    : sse2::sweep_exponential(pass, fields, relaxation);
  case SimdLevel::avx2:
    return two_rate ? avx2::sweep_two_rate(pass, fields, relaxation)
                    : avx2::sweep_exponential(pass, fields, relaxation);
  case SimdLevel::avx512:
    return two_rate ? avx512::sweep_two_rate(pass, fields, relaxation)
                    : avx512::sweep_exponential(pass, fields, relaxation);
  }
}

}  // namespace

void sweep(Pass pass, const SweepFields<double>& fields, const Relaxation& relaxation,
           SimdLevel level) {
  dispatch(pass, fields, relaxation, level);
}

void sweep(Pass pass, const SweepFields<float>& fields, const Relaxation& relaxation,
           SimdLevel level) {
  dispatch(pass, fields, relaxation, level);
}

template <class Real> void wrap_row_home(const SweepFields<Real>& s, int y, int z) {
  const std::ptrdiff_t at = y * s.f_row + z * s.f_plane;
  for (int i = 0; i < 19; ++i) {
    const int ex = lattice::d3q19::e[static_cast<std::size_t>(i)][0];
    if (ex > 0) s.f[i][at] = s.f[i][at + s.wrap_x];
    if (ex < 0) s.f[i][at + s.wrap_x - 1] = s.f[i][at - 1];
  }
}
template void wrap_row_home(const SweepFields<double>&, int, int);
template void wrap_row_home(const SweepFields<float>&, int, int);

}  // namespace hemomag::fluid
