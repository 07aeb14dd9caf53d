#include "ibm/transfer.hpp"

#include "ibm/transfer_points.hpp"

namespace hemomag::ibm {
namespace {

/// @param value  velocity or force of every point; only written by interpolate
template <class Node>
TransferArgs<Node> arguments(DeltaKernel kernel, const NodeVectorView<Node>& nodes,
                             std::span<const Vec3> x_v, const Selection& selection,
                             const Vec3* value) {
  TransferArgs<Node> a{};
  a.kernel = static_cast<int>(kernel);
  a.row = nodes.layout.row;
  a.plane = nodes.layout.plane;
  a.lowest = -nodes.layout.halo;
  for (std::size_t d = 0; d < 3; ++d) {
    a.node[d] = nodes.at[d];
    a.begin[d] = nodes.begin[d];
    a.highest[d] = nodes.layout.size[d] + nodes.layout.halo - 1;
  }
  a.n = static_cast<std::ptrdiff_t>(x_v.size());
  if (a.n > 0) {
    a.x = &x_v[0].x;
    a.value = const_cast<double*>(&value->x);
  }
  a.mask = selection.mask.data();
  a.bits = selection.bits;
  a.without = selection.without;
  return a;
}

template <class Node> std::ptrdiff_t interpolate(const TransferArgs<Node>& a, SimdLevel level) {
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

template <class Node> std::ptrdiff_t spread(const TransferArgs<Node>& a, SimdLevel level) {
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

}  // namespace

std::ptrdiff_t interpolate(DeltaKernel kernel, const NodeVectorView<const double>& u,
                           std::span<const Vec3> x_v, const Selection& selection,
                           std::span<Vec3> u_v, SimdLevel level) {
  return interpolate(arguments(kernel, u, x_v, selection, u_v.data()), level);
}

std::ptrdiff_t interpolate(DeltaKernel kernel, const NodeVectorView<const float>& u,
                           std::span<const Vec3> x_v, const Selection& selection,
                           std::span<Vec3> u_v, SimdLevel level) {
  return interpolate(arguments(kernel, u, x_v, selection, u_v.data()), level);
}

std::ptrdiff_t spread(DeltaKernel kernel, const NodeVectorView<double>& force,
                      std::span<const Vec3> x_v, const Selection& selection,
                      std::span<const Vec3> f_v, SimdLevel level) {
  return spread(arguments(kernel, force, x_v, selection, f_v.data()), level);
}

std::ptrdiff_t spread(DeltaKernel kernel, const NodeVectorView<float>& force,
                      std::span<const Vec3> x_v, const Selection& selection,
                      std::span<const Vec3> f_v, SimdLevel level) {
  return spread(arguments(kernel, force, x_v, selection, f_v.data()), level);
}

}  // namespace hemomag::ibm
