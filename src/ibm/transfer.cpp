#include "ibm/transfer.hpp"

#include "ibm/transfer_points.hpp"

namespace hemomag::ibm {
namespace {

template <class T>
TransferArgs arguments(DeltaKernel kernel, const NodeVectorView<T>& nodes,
                       std::span<const Vec3> x_v, const Selection& selection) {
  TransferArgs a{};
  a.kernel = static_cast<int>(kernel);
  a.row = nodes.layout.row;
  a.plane = nodes.layout.plane;
  a.lowest = -nodes.layout.halo;
  for (int d = 0; d < 3; ++d) {
    a.node[d] = const_cast<double*>(nodes.at[d]);
    a.begin[d] = nodes.begin[d];
    a.highest[d] = nodes.layout.size[d] + nodes.layout.halo - 1;
  }
  a.x = x_v.empty() ? nullptr : &x_v[0].x;
  a.n = static_cast<std::ptrdiff_t>(x_v.size());
  a.mask = selection.mask.data();
  a.bits = selection.bits;
  a.without = selection.without;
  return a;
}

}  // namespace

std::ptrdiff_t interpolate(DeltaKernel kernel, const NodeVectorView<const double>& u,
                           std::span<const Vec3> x_v, const Selection& selection,
                           std::span<Vec3> u_v, SimdLevel level) {
  TransferArgs a = arguments(kernel, u, x_v, selection);
  a.value = u_v.empty() ? nullptr : &u_v[0].x;
  switch (level) {
  case SimdLevel::sse2:
    return sse2::interpolate(a);
  case SimdLevel::avx2:
    return avx2::interpolate(a);
  case SimdLevel::avx512:
    return avx512::interpolate(a);
  }
  return -1;
}

std::ptrdiff_t spread(DeltaKernel kernel, const NodeVectorView<double>& force,
                      std::span<const Vec3> x_v, const Selection& selection,
                      std::span<const Vec3> f_v, SimdLevel level) {
  TransferArgs a = arguments(kernel, force, x_v, selection);
  a.value = f_v.empty() ? nullptr : const_cast<double*>(&f_v[0].x);
  switch (level) {
  case SimdLevel::sse2:
    return sse2::spread(a);
  case SimdLevel::avx2:
    return avx2::spread(a);
  case SimdLevel::avx512:
    return avx512::spread(a);
  }
  return -1;
}

}  // namespace hemomag::ibm
