#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "base/vec3.hpp"
#include "fluid/plates.hpp"
#include "lattice/node_layout.hpp"

namespace hemomag::fluid {

/// What interpolation and spreading see beyond a curved wall. A solid node s at distance d_s < 0
/// from the wall continues the flow of the nearest fluid nodes k within two nodes of it, by the
/// least squares of a flow that vanishes at the wall and grows with the distance from it:
///
///   u_s = d_s sum_k w_k d_k u_k / sum_k w_k d_k^2,    w_k = 1/|x_k - x_s|^4
///
/// which is exact for a linear flow along a plane wall, as the mirror rule of plates is. Forces
/// that kernels spread on solid nodes go to fluid nodes by the adjoint; the wall takes the rest.
template <class Real> class WallGhosts {
public:
  WallGhosts() = default;

  /// @param distance  from the wall at the nodes of block and halo (at least two nodes)
  WallGhosts(const lattice::NodeLayout& layout, const Real* distance);

  /// Set the velocity of the block's solid nodes. Halo values of fluid nodes must be there.
  void fill_velocity(const NodeVector<Real>& u) const;

  /// Move the force of the block's solid nodes to fluid nodes of block and halo.
  /// @return the wall's share, so that force on nodes + share = force spread
  Vec3 fold_force(const NodeVector<Real>& force) const;

private:
  struct Term {
    std::ptrdiff_t node;
    Real weight;
  };
  struct Ghost {
    std::ptrdiff_t node;
    std::size_t end;  ///< of its terms
    Real share;       ///< what the wall takes of a force
  };
  std::vector<Ghost> ghosts_;
  std::vector<Term> terms_;
};

}  // namespace hemomag::fluid
