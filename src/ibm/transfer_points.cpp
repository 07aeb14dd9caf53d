// Compiled once per instruction set (hemo_simd): the point loops behind ibm/transfer.hpp.
#include "ibm/transfer_points.hpp"

#include "ibm/delta_kernel.hpp"

namespace hemomag::ibm::HEMOMAG_SIMD {
namespace {

typedef double Four __attribute__((vector_size(32)));
typedef double UnalignedFour __attribute__((vector_size(32), aligned(8), may_alias));
typedef float FourFloats __attribute__((vector_size(16)));
typedef float UnalignedFourFloats __attribute__((vector_size(16), aligned(4), may_alias));

struct Stencil {
  std::ptrdiff_t first;  ///< offset of the lowest node
  Four wx;
  double wy[4], wz[4];
};

/// The nodes and weights of one point; false when they leave the halo.
template <DeltaKernel kernel, class Node>
[[gnu::always_inline]] inline bool stencil(const TransferArgs<Node>& a, const double* x,
                                           Stencil& s) {
  int first[3];
  double w[3][4];
  for (int d = 0; d < 3; ++d) {
    const double at = x[d] - a.begin[d] - 0.5;
    if (!(at > -1e6 && at < 1e6)) return false;
    const double below = __builtin_floor(at);
    first[d] = static_cast<int>(below) - 1;
    if (first[d] < a.lowest || first[d] + 3 > a.highest[d]) return false;
    kernel_weights(kernel, at - below, w[d]);
  }
  s.first = first[0] + a.row * first[1] + a.plane * first[2];
  s.wx = Four{w[0][0], w[0][1], w[0][2], w[0][3]};
  for (int k = 0; k < 4; ++k) s.wy[k] = w[1][k], s.wz[k] = w[2][k];
  return true;
}

[[gnu::always_inline]] inline Four load(const double* p) {
  return *reinterpret_cast<const UnalignedFour*>(p);
}
[[gnu::always_inline]] inline Four load(const float* p) {
  return __builtin_convertvector(*reinterpret_cast<const UnalignedFourFloats*>(p), Four);
}
[[gnu::always_inline]] inline void add(double* p, Four v) {
  *reinterpret_cast<UnalignedFour*>(p) += v;
}
[[gnu::always_inline]] inline void add(float* p, Four v) {
  *reinterpret_cast<UnalignedFourFloats*>(p) += __builtin_convertvector(v, FourFloats);
}
[[gnu::always_inline]] inline double sum(Four v) { return (v[0] + v[1]) + (v[2] + v[3]); }

template <class Node>
[[gnu::always_inline]] inline void gather(const TransferArgs<Node>& a, const Stencil& s,
                                          double* u) {
  Four ux{}, uy{}, uz{};
#pragma GCC unroll 4
  for (int k = 0; k < 4; ++k)
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j) {
      const std::ptrdiff_t at = s.first + j * a.row + k * a.plane;
      const double w = s.wy[j] * s.wz[k];
      ux += w * load(a.node[0] + at);
      uy += w * load(a.node[1] + at);
      uz += w * load(a.node[2] + at);
    }
  u[0] = sum(ux * s.wx);
  u[1] = sum(uy * s.wx);
  u[2] = sum(uz * s.wx);
}

template <class Node>
[[gnu::always_inline]] inline void scatter(const TransferArgs<Node>& a, const Stencil& s,
                                           const double* f) {
  const Four fx = s.wx * f[0], fy = s.wx * f[1], fz = s.wx * f[2];
#pragma GCC unroll 4
  for (int k = 0; k < 4; ++k)
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j) {
      const std::ptrdiff_t at = s.first + j * a.row + k * a.plane;
      const double w = s.wy[j] * s.wz[k];
      add(a.node[0] + at, w * fx);
      add(a.node[1] + at, w * fy);
      add(a.node[2] + at, w * fz);
    }
}

enum class Direction { to_points, to_nodes };

template <DeltaKernel kernel, Direction direction, class Node>
[[gnu::always_inline]] inline std::ptrdiff_t transfer(const TransferArgs<Node>& a) {
  std::ptrdiff_t lost = -1;
  for (std::ptrdiff_t i = 0; i < a.n; ++i) {
    if (!(a.mask[i] & a.bits) || (a.mask[i] & a.without)) continue;
    Stencil s;
    if (!stencil<kernel>(a, a.x + 3 * i, s)) {
      if (lost < 0) lost = i;
      continue;
    }
    if constexpr (direction == Direction::to_nodes)
      scatter(a, s, a.value + 3 * i);
    else
      gather(a, s, a.value + 3 * i);
  }
  return lost;
}

/// The kernel is chosen once for all points.
template <Direction direction, class Node>
[[gnu::always_inline]] inline std::ptrdiff_t transfer(const TransferArgs<Node>& a) {
  switch (static_cast<DeltaKernel>(a.kernel)) {
  case DeltaKernel::cosine4:
    return transfer<DeltaKernel::cosine4, direction>(a);
  case DeltaKernel::peskin4:
    return transfer<DeltaKernel::peskin4, direction>(a);
  case DeltaKernel::roma3:
    return transfer<DeltaKernel::roma3, direction>(a);
  case DeltaKernel::linear2:
    return transfer<DeltaKernel::linear2, direction>(a);
  }
  return -1;
}

}  // namespace

std::ptrdiff_t interpolate(const TransferArgs<const double>& a) {
  return transfer<Direction::to_points>(a);
}
std::ptrdiff_t interpolate(const TransferArgs<const float>& a) {
  return transfer<Direction::to_points>(a);
}
std::ptrdiff_t spread(const TransferArgs<double>& a) { return transfer<Direction::to_nodes>(a); }
std::ptrdiff_t spread(const TransferArgs<float>& a) { return transfer<Direction::to_nodes>(a); }

}  // namespace hemomag::ibm::HEMOMAG_SIMD
