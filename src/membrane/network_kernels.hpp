#pragma once
#include <cstddef>

// The plain-pointer face of network_kernels.cpp, which is compiled once per instruction set. Lists
// are padded to whole groups of `list_padding` elements, from `begin` on: the padding repeats an
// element, is computed and never added to a force.

namespace hemomag::membrane {

inline constexpr std::ptrdiff_t list_padding = 8;  ///< lanes of the widest SIMD vector

/// Springs with the same exponent.
struct EdgeArgs {
  const double* x;       ///< [n_v][3]
  double* f;             ///< [n_v][3], accumulated
  const int* vertex[2];  ///< [n_e] each
  const double *l_max, *wlc, *k_p;
  double m;
  std::ptrdiff_t begin, count;
};

/// The triangles of one cell.
struct TriangleArgs {
  const double* x;            ///< [n_v][3]
  double* f;                  ///< [n_v][3], accumulated
  const int* vertex[3];       ///< [n_t] each
  const double* unwrap[3];    ///< [n_t] each, from vertex 1 to the cell's own image
  const double *k_d, *area0;  ///< local constant and rest area
  double area_pull;           ///< dE/dA of the cell's whole area
  double volume_pull;         ///< dE/dV
  std::ptrdiff_t begin, count;
};

struct CellGeometry {
  double area, volume;
};

struct HingeArgs {
  const double* x;       ///< [n_v][3]
  double* f;             ///< [n_v][3], accumulated
  const int* vertex[4];  ///< [n_h] each
  const double *k_b, *sine0, *cosine0;
  std::ptrdiff_t begin, count;
};

// edge_forces returns the first edge that is as long as its l_max or not a number, else -1.
namespace sse2 {
std::ptrdiff_t edge_forces(const EdgeArgs&);
CellGeometry cell_geometry(const TriangleArgs&);
void triangle_forces(const TriangleArgs&);
void hinge_forces(const HingeArgs&);
}  // namespace sse2
namespace avx2 {
std::ptrdiff_t edge_forces(const EdgeArgs&);
CellGeometry cell_geometry(const TriangleArgs&);
void triangle_forces(const TriangleArgs&);
void hinge_forces(const HingeArgs&);
}  // namespace avx2
namespace avx512 {
std::ptrdiff_t edge_forces(const EdgeArgs&);
CellGeometry cell_geometry(const TriangleArgs&);
void triangle_forces(const TriangleArgs&);
void hinge_forces(const HingeArgs&);
}  // namespace avx512

}  // namespace hemomag::membrane
