#pragma once
// The loop over rows that every collision shares. Included by files that are compiled once per
// instruction set (hemo_simd), and by no other: everything lies in the namespace HEMOMAG_SIMD.
#include "fluid/sweep.hpp"

namespace hemomag::fluid::HEMOMAG_SIMD {
namespace {

#if defined(HEMOMAG_SIMD_avx512)
constexpr int vector_bytes = 64;
#elif defined(HEMOMAG_SIMD_avx2)
constexpr int vector_bytes = 32;
#else
constexpr int vector_bytes = 16;
#endif

/// A vector of as many numbers as a register of this level holds.
template <class Real> struct Simd {
  typedef Real Vector __attribute__((vector_size(vector_bytes)));
  typedef Real Unaligned
      __attribute__((vector_size(vector_bytes), aligned(alignof(Real)), may_alias));
  static constexpr int lanes = vector_bytes / static_cast<int>(sizeof(Real));
};

template <class Real>
[[gnu::always_inline]] inline typename Simd<Real>::Vector load(const Real* p) {
  return *reinterpret_cast<const typename Simd<Real>::Unaligned*>(p);
}
template <class Real>
[[gnu::always_inline]] inline void store(Real* p, typename Simd<Real>::Vector v) {
  *reinterpret_cast<typename Simd<Real>::Unaligned*>(p) = v;
}

// e_x, e_y, e_z and the opposite direction, spelled out: this file may not share code with others.
constexpr int ex[19] = {0, 1, -1, 0, 0, 0, 0, 1, 1, -1, -1, 1, -1, 1, -1, 0, 0, 0, 0};
constexpr int ey[19] = {0, 0, 0, 1, -1, 0, 0, 1, -1, 1, -1, 0, 0, 0, 0, 1, 1, -1, -1};
constexpr int ez[19] = {0, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0, 1, 1, -1, -1, 1, -1, 1, -1};
constexpr int opposite[19] = {0, 2, 1, 4, 3, 6, 5, 10, 9, 8, 7, 14, 13, 12, 11, 18, 17, 16, 15};

/// Ghosts of a row of a node field, from its other end.
template <class Real> [[gnu::always_inline]] inline void wrap_ghosts(Real* row, int n, int halo) {
  for (int k = 0; k < halo; ++k) {
    row[-1 - k] = row[n - 1 - k];
    row[n + k] = row[k];
  }
}

/// After a local pass: the ghosts of a row take what will enter from its other end.
template <class Real>
[[gnu::always_inline]] inline void wrap_forward(const SweepFields<Real>& s, std::ptrdiff_t at) {
  for (int i = 0; i < 19; ++i) {
    if (ex[i] < 0) s.f[i][at - 1] = s.f[i][at + s.wrap_x - 1];
    if (ex[i] > 0) s.f[i][at + s.wrap_x] = s.f[i][at];
  }
}

/// After a shift pass: what was written to the ghosts of a row goes to its other end.
template <class Real>
[[gnu::always_inline]] inline void wrap_home(const SweepFields<Real>& s, std::ptrdiff_t at) {
  for (int i = 0; i < 19; ++i) {
    if (ex[i] > 0) s.f[i][at] = s.f[i][at + s.wrap_x];
    if (ex[i] < 0) s.f[i][at + s.wrap_x - 1] = s.f[i][at - 1];
  }
}

template <class Real>
[[gnu::always_inline]] inline void wrap_plane_home(const SweepFields<Real>& s, int z) {
  for (int y = s.y_lo; y < s.y_hi; ++y) wrap_home(s, y * s.f_row + z * s.f_plane);
}

/// Sweep all rows. `site(at, node, g, F, wet)` collides one vector of nodes: `at` and `node`
/// are its offsets in the layouts of f and of force, `wet` sets solid nodes to zero. It stores
/// velocity and whatever else it keeps itself and leaves the new populations in g.
template <Pass pass, bool solid, class Real, class Site, class RowDone>
[[gnu::always_inline]] inline void sweep_rows(const SweepFields<Real>& s, const double* body,
                                              Site site, RowDone row_done) {
  using Vector = typename Simd<Real>::Vector;
  const Real body_force[3] = {static_cast<Real>(body[0]), static_cast<Real>(body[1]),
                              static_cast<Real>(body[2])};
  for (int z = s.z_lo; z < s.z_hi; ++z) {
    for (int y = s.y_lo; y < s.y_hi; ++y) {
      const std::ptrdiff_t at = y * s.f_row + z * s.f_plane;
      const std::ptrdiff_t node = y * s.n_row + z * s.n_plane;
      const Real* from[19];
      Real* to[19];
      for (int i = 0; i < 19; ++i) {
        const std::ptrdiff_t shift = ex[i] + ey[i] * s.f_row + ez[i] * s.f_plane;
        from[i] = pass == Pass::local ? s.f[i] + at : s.f[opposite[i]] + at - shift;
        to[i] = pass == Pass::local ? s.f[opposite[i]] + at : s.f[i] + at + shift;
      }
      for (int x = 0; x < s.padded_x; x += Simd<Real>::lanes) {
        Vector g[19];
#pragma GCC unroll 19
        for (int i = 0; i < 19; ++i) g[i] = load(from[i] + x);
        Vector F[3] = {load(s.force[0] + node + x) + body_force[0],
                       load(s.force[1] + node + x) + body_force[1],
                       load(s.force[2] + node + x) + body_force[2]};
        if constexpr (solid) {
          const auto wet = load(s.distance + node + x) > Real(0);
          const Vector none{};
          for (int d = 0; d < 3; ++d) F[d] = wet ? F[d] : none;
          site(at + x, node + x, g, F, [&](Vector v) { return wet ? v : none; });
        } else {
          site(at + x, node + x, g, F, [](Vector v) { return v; });
        }
#pragma GCC unroll 19
        for (int i = 0; i < 19; ++i) store(to[i] + x, g[i]);
      }
      if (s.wrap_x > 0) {
        for (int d = 0; d < 3; ++d) wrap_ghosts(s.u[d] + node, s.wrap_x, s.n_halo);
        if (pass == Pass::local) wrap_forward(s, at);
      }
      row_done(at);
    }
    // A plane has received all it will get once the next one is done.
    if (pass == Pass::shift && s.wrap_x > 0 && z > s.z_lo) wrap_plane_home(s, z - 1);
  }
  if (pass == Pass::shift && s.wrap_x > 0 && s.z_hi > s.z_lo) wrap_plane_home(s, s.z_hi - 1);
}

}  // namespace
}  // namespace hemomag::fluid::HEMOMAG_SIMD
