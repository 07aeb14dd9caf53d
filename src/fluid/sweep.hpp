#pragma once
#include <cstddef>

#include "base/simd.hpp"
#include "fluid/relaxation.hpp"

// One pass over the nodes of a block: read populations and force, write velocity and post-collision
// populations in place (the AA pattern: Bailey et al., ICPP 2009). Two kinds of pass alternate:
//
//   local   node x reads  f_i(x)            and writes f_i* to slot opposite(i) of x
//   shift   node x reads  slot opposite(i) of x - e_i, which is f_i*(x - e_i) = f_i(x, t+1),
//           collides, and writes f_i* to slot i of x + e_i, which is f_i(x + e_i, t+2)
//
// A shift pass reads and writes the same 19 places, so rows may be swept in any order. Before it
// the ghost nodes must hold the neighbours' values, after it what was written to ghosts must go
// home (solver/lattice_fluid.hpp), and walls turn populations back between two places
// (fluid/plates.hpp, fluid/wall_links.hpp).

namespace hemomag::fluid {

enum class Pass { local, shift };

/// Numbers of a node that the exponential scheme remembers (fluid/exponential.hpp).
inline constexpr int sources = 10;

/// Everything a sweep touches. Pointers are at node (0, 0, 0); strides in elements.
template <class Real> struct SweepFields {
  Real* f[19];  ///< populations f_i - w_i
  std::ptrdiff_t f_row, f_plane;
  const Real* force[3];           ///< force density on the nodes
  Real* u[3];                     ///< velocity, written
  const Real* distance;           ///< from the wall, not above 0 in solid nodes; or null: no solid
  std::ptrdiff_t n_row, n_plane;  ///< of force, u and distance
  int size_x, padded_x;           ///< nodes along x, and rounded up to whole vectors
  int y_lo, y_hi, z_lo, z_hi;
  /// Where the block closes on itself along x its ghosts are kept while a row is in the cache: then
  /// the number of nodes along x and the ghosts of force and velocity. Otherwise 0.
  int wrap_x, n_halo;
  /// Exponential scheme only, laid out as f: its numbers of the last step, ghosts included, and
  /// those of the step before it, which are replaced by the present ones.
  const Real* last[sources];
  Real* present[sources];
};

/// Sweep the rows of `fields`, vectorised for `level`, with the collision of `relaxation`
/// (fluid/trt.hpp, fluid/exponential.hpp). Solid nodes stay at rest.
void sweep(Pass pass, const SweepFields<double>& fields, const Relaxation& relaxation,
           SimdLevel level);
void sweep(Pass pass, const SweepFields<float>& fields, const Relaxation& relaxation,
           SimdLevel level);

/// After a shift pass over part of a block: bring what rows got from others along x home again.
template <class Real> void wrap_row_home(const SweepFields<Real>& fields, int y, int z);

}  // namespace hemomag::fluid
