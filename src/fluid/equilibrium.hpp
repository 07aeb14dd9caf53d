#pragma once
#include <array>

#include "base/vec3.hpp"

namespace hemomag::fluid {

using VelocityGradient = std::array<Vec3, 3>;  ///< [a] = d u / d x_a

/// Populations f_i - w_i of density `rho` and velocity `u` (Eq. 5) with the first-order
/// non-equilibrium part of a velocity gradient, - 3 w_i rho tau e_i . (e_i . grad) u + w_i rho tau
/// div u (Chapman-Enskog), so that a flow that is linear in space starts without a transient.
std::array<double, 19> populations(double rho, const Vec3& u, const VelocityGradient& grad_u,
                                   double tau);

}  // namespace hemomag::fluid
