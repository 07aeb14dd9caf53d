#pragma once
#include <cstddef>

// Eq. 24 for one carrier and its neighbours, several at a time: the plain-pointer face of
// dipole_rows.cpp, which is compiled once per instruction set.

namespace hemomag::magnetic {

inline constexpr std::ptrdiff_t most_in_row = 512;  ///< neighbours in one call

struct DipoleRow {
  const double* x;  ///< [n][3]  positions
  const double* m;  ///< [n][3]  moments
  double* f;        ///< [n][3]  forces, accumulated: on the neighbours, and the opposite on `i`
  int i;
  const int* neighbours;  ///< [count]  indices, masked with `index_mask`
  int index_mask;
  std::ptrdiff_t count;  ///< at most most_in_row
  double cutoff2;        ///< square of the distance from which on there is no force
  double contact2;       ///< square of the distance within which a pair may touch
  int* touching;         ///< [most_in_row]  out: neighbours nearer than that, in the list's order
};

// Each returns the number of touching neighbours, whose repulsion is the caller's affair.
namespace sse2 {
std::ptrdiff_t dipole_row(const DipoleRow&);
}
namespace avx2 {
std::ptrdiff_t dipole_row(const DipoleRow&);
}
namespace avx512 {
std::ptrdiff_t dipole_row(const DipoleRow&);
}

/// With the widest instruction set of this processor (base/simd.hpp).
std::ptrdiff_t dipole_row(const DipoleRow&);

}  // namespace hemomag::magnetic
