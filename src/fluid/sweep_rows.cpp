// Compiled once per instruction set (hemo_simd): the vectorised rows behind fluid/sweep.hpp.
#include "fluid/sweep_rows.hpp"

#include "fluid/trt.hpp"

namespace hemomag::fluid::HEMOMAG_SIMD {
namespace {

#if defined(HEMOMAG_SIMD_avx512)
constexpr int vector_bytes = 64;
#elif defined(HEMOMAG_SIMD_avx2)
constexpr int vector_bytes = 32;
#else
constexpr int vector_bytes = 16;
#endif

typedef double Vector __attribute__((vector_size(vector_bytes)));
typedef double Unaligned __attribute__((vector_size(vector_bytes), aligned(8), may_alias));
constexpr int lanes = vector_bytes / static_cast<int>(sizeof(double));

[[gnu::always_inline]] inline Vector load(const double* p) {
  return *reinterpret_cast<const Unaligned*>(p);
}
[[gnu::always_inline]] inline void store(double* p, Vector v) {
  *reinterpret_cast<Unaligned*>(p) = v;
}

// e_x, e_y, e_z and the opposite direction, spelled out: this file may not share code with others.
constexpr int ex[19] = {0, 1, -1, 0, 0, 0, 0, 1, 1, -1, -1, 1, -1, 1, -1, 0, 0, 0, 0};
constexpr int ey[19] = {0, 0, 0, 1, -1, 0, 0, 1, -1, 1, -1, 0, 0, 0, 0, 1, 1, -1, -1};
constexpr int ez[19] = {0, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0, 1, 1, -1, -1, 1, -1, 1, -1};
constexpr int opposite[19] = {0, 2, 1, 4, 3, 6, 5, 10, 9, 8, 7, 14, 13, 12, 11, 18, 17, 16, 15};

/// Ghosts of a row's velocity, from its other end.
[[gnu::always_inline]] inline void wrap_velocity(const SweepFields& s, std::ptrdiff_t node) {
  for (int d = 0; d < 3; ++d) {
    double* u = s.u[d] + node;
    for (int k = 0; k < s.n_halo; ++k) {
      u[-1 - k] = u[s.wrap_x - 1 - k];
      u[s.wrap_x + k] = u[k];
    }
  }
}

/// After a local pass: the ghosts of a row take what will enter from its other end.
[[gnu::always_inline]] inline void wrap_forward(const SweepFields& s, std::ptrdiff_t at) {
  for (int i = 0; i < 19; ++i) {
    if (ex[i] < 0) s.f[i][at - 1] = s.f[i][at + s.wrap_x - 1];
    if (ex[i] > 0) s.f[i][at + s.wrap_x] = s.f[i][at];
  }
}

/// After a shift pass: what was written to the ghosts of a row goes to its other end.
[[gnu::always_inline]] inline void wrap_home(const SweepFields& s, std::ptrdiff_t at) {
  for (int i = 0; i < 19; ++i) {
    if (ex[i] > 0) s.f[i][at] = s.f[i][at + s.wrap_x];
    if (ex[i] < 0) s.f[i][at + s.wrap_x - 1] = s.f[i][at - 1];
  }
}

[[gnu::always_inline]] inline void wrap_plane_home(const SweepFields& s, int z) {
  for (int y = s.y_lo; y < s.y_hi; ++y) wrap_home(s, y * s.f_row + z * s.f_plane);
}

template <Pass pass>
[[gnu::always_inline]] inline void sweep(const SweepFields& s, const TrtRates<double>& rate,
                                         const double* body) {
  for (int z = s.z_lo; z < s.z_hi; ++z) {
    for (int y = s.y_lo; y < s.y_hi; ++y) {
      const std::ptrdiff_t at = y * s.f_row + z * s.f_plane;
      const std::ptrdiff_t node = y * s.n_row + z * s.n_plane;
      const double* from[19];
      double* to[19];
      for (int i = 0; i < 19; ++i) {
        const std::ptrdiff_t shift = ex[i] + ey[i] * s.f_row + ez[i] * s.f_plane;
        from[i] = pass == Pass::local ? s.f[i] + at : s.f[opposite[i]] + at - shift;
        to[i] = pass == Pass::local ? s.f[opposite[i]] + at : s.f[i] + at + shift;
      }
      for (int x = 0; x < s.padded_x; x += lanes) {
        Vector g[19];
#pragma GCC unroll 19
        for (int i = 0; i < 19; ++i) g[i] = load(from[i] + x);
        const Vector F[3] = {load(s.force[0] + node + x) + body[0],
                             load(s.force[1] + node + x) + body[1],
                             load(s.force[2] + node + x) + body[2]};
        const auto u = collide_trt(g, F, rate);
        store(s.u[0] + node + x, u[0]);
        store(s.u[1] + node + x, u[1]);
        store(s.u[2] + node + x, u[2]);
#pragma GCC unroll 19
        for (int i = 0; i < 19; ++i) store(to[i] + x, g[i]);
      }
      if (s.wrap_x > 0) {
        wrap_velocity(s, node);
        if (pass == Pass::local) wrap_forward(s, at);
      }
    }
    // A plane has received all it will get once the next one is done.
    if (pass == Pass::shift && s.wrap_x > 0 && z > s.z_lo) wrap_plane_home(s, z - 1);
  }
  if (pass == Pass::shift && s.wrap_x > 0 && s.z_hi > s.z_lo) wrap_plane_home(s, s.z_hi - 1);
}

}  // namespace

void sweep_trt(Pass pass, const SweepFields& fields, const Relaxation& r) {
  const double plus = 1.0 / r.tau, minus = 1.0 / (0.5 + r.magic / (r.tau - 0.5));
  const TrtRates<double> rate{plus, minus, 1 - 0.5 * plus, 1 - 0.5 * minus};
  if (pass == Pass::local)
    sweep<Pass::local>(fields, rate, r.force);
  else
    sweep<Pass::shift>(fields, rate, r.force);
}

}  // namespace hemomag::fluid::HEMOMAG_SIMD
