#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "base/simd.hpp"
#include "base/vec3.hpp"
#include "ibm/delta_kernel.hpp"
#include "lattice/node_layout.hpp"

// Between Lagrangian points and lattice nodes (Eqs. 29, 32, 34, 36).

namespace hemomag::ibm {

/// Which points take part: those with (mask[i] & bits) != 0 and (mask[i] & without) == 0.
struct Selection {
  std::span<const int> mask;
  int bits = 0;
  int without = 0;
};

/// A vector field on the nodes of a block with its halo, and where the block lies.
template <class T> struct NodeVectorView {
  std::array<T*, 3> at;  ///< component arrays, at node (0, 0, 0)
  lattice::NodeLayout layout;
  std::array<double, 3> begin;  ///< global index of node (0, 0, 0)
};

/// u_v = sum_n u_n delta(x_n - x_v): velocity of the selected points (Eqs. 32, 34).
/// @param x_v  positions, lattice units; their kernels must lie within block and halo
/// @param u_v  velocities of the selected points, overwritten; others are left alone
/// Weights and sums are double whatever the nodes are. Cost: 64 nodes a point; nodes a kernel does
/// not touch are read too, with the weight zero, and so must be finite.
/// @return the index of the first point whose kernel leaves the halo, or -1; that point is skipped
std::ptrdiff_t interpolate(DeltaKernel kernel, const NodeVectorView<const double>& u,
                           std::span<const Vec3> x_v, const Selection& selection,
                           std::span<Vec3> u_v, SimdLevel level);
std::ptrdiff_t interpolate(DeltaKernel kernel, const NodeVectorView<const float>& u,
                           std::span<const Vec3> x_v, const Selection& selection,
                           std::span<Vec3> u_v, SimdLevel level);

/// f_n += sum_v f_v delta(x_n - x_v) (Eqs. 29, 36), the adjoint of interpolate: conserves the total
/// force to round-off of the node type, halo included; the caller sums halos. Products are double
/// and rounded once to the node type before they are added. Points are taken in order, so the
/// result is reproducible.
std::ptrdiff_t spread(DeltaKernel kernel, const NodeVectorView<double>& force,
                      std::span<const Vec3> x_v, const Selection& selection,
                      std::span<const Vec3> f_v, SimdLevel level);
std::ptrdiff_t spread(DeltaKernel kernel, const NodeVectorView<float>& force,
                      std::span<const Vec3> x_v, const Selection& selection,
                      std::span<const Vec3> f_v, SimdLevel level);

}  // namespace hemomag::ibm
