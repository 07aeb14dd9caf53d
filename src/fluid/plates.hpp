#pragma once
#include <array>

#include "base/vec3.hpp"
#include "lattice/node_layout.hpp"

// Plates: half-way bounce-back on the ghost layer beyond a face of the block (Ladd, J. Fluid Mech.
// 271:285, 1994), and the mirror rule by which interpolation and spreading see a plate. A plate
// lies half-way between the first node and its ghost. Real is the type populations are stored in.

namespace hemomag::fluid {

enum class Side { low, high };

/// One face of a block that is a plate.
struct Plate {
  int axis;       ///< 0, 1 or 2: its normal
  Side side;      ///< low: below node 0; high: above the last node
  Vec3 velocity;  ///< lattice units
};

/// The layer of nodes that touch a plate.
lattice::NodeBox first_layer(const Plate& plate, const lattice::NodeLayout& layout);

template <class Real> using Populations = std::array<Real*, 19>;  ///< at node (0, 0, 0)
template <class Real> using NodeVector = std::array<Real*, 3>;    ///< at node (0, 0, 0)

/// Before a shift pass: put into the plate's ghost nodes what half-way bounce-back returns to the
/// fluid, f_i(x, t+1) = f_opp(i)*(x, t) + 6 w_i e_i . u_w (rho_w = 1).
/// @param streamed  the part of the wall's push that streams (1; exponential scheme:
///                  ExponentialRates::streamed)
/// @return momentum given to the plate in this step
template <class Real>
Vec3 bounce_before_shift(const Plate& plate, const Populations<Real>& f,
                         const lattice::NodeLayout& layout, double streamed);

/// After a shift pass: turn the populations that were written into the plate's ghosts back.
/// @return momentum given to the plate in this step
template <class Real>
Vec3 bounce_after_shift(const Plate& plate, const Populations<Real>& f,
                        const lattice::NodeLayout& layout, double streamed);

/// Ghost velocities u(ghost) = 2 u_wall - u(mirror node), exact for linear flow, in `box` (the
/// block's nodes and halo along the two other axes; its extent along the plate's axis is ignored).
template <class Real>
void fill_mirror_velocity(const Plate& plate, const NodeVector<Real>& u,
                          const lattice::NodeLayout& layout, const lattice::NodeBox& box);

/// The adjoint for forces: the mirror node takes the ghost's force with the opposite sign, ghosts
/// are emptied.
/// @return the plate's share, so that force on nodes + share = force spread
template <class Real>
Vec3 fold_mirror_force(const Plate& plate, const NodeVector<Real>& force,
                       const lattice::NodeLayout& layout, const lattice::NodeBox& box);

}  // namespace hemomag::fluid
