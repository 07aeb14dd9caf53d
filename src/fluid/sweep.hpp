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
// home (solver/population_halo.hpp, fluid/plates.hpp).

namespace hemomag::fluid {

enum class Pass { local, shift };

/// Everything a sweep touches. Pointers are at node (0, 0, 0); strides in elements.
struct SweepFields {
  double* f[19];  ///< populations f_i - w_i
  std::ptrdiff_t f_row, f_plane;
  const double* force[3];         ///< force density on the nodes
  double* u[3];                   ///< velocity, written
  std::ptrdiff_t n_row, n_plane;  ///< of force and u
  int padded_x;                   ///< row length in whole vectors of the widest level
  int y_lo, y_hi, z_lo, z_hi;
  /// Where the block closes on itself along x its ghosts are kept while a row is in the cache: then
  /// the number of nodes along x and the ghosts of force and velocity. Otherwise 0.
  int wrap_x, n_halo;
};

/// Sweep the rows of `fields` with the TRT collision (fluid/trt.hpp), vectorised for `level`.
void sweep_trt(Pass pass, const SweepFields& fields, const Relaxation& relaxation, SimdLevel level);

}  // namespace hemomag::fluid
