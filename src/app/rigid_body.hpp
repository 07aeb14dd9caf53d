#pragma once
#include "membrane/mesh.hpp"

// A rigid body free to move in Stokes flow, as what a tumbling cell is compared with.

namespace hemomag::app {

/// How a rigid body turns in v_y = z (shear rate one, unbounded): Jeffery's orbit
/// phi' = -(r^2 cos^2 phi + sin^2 phi)/(1 + r^2), which holds for every body of revolution with its
/// own r (Bretherton, J. Fluid Mech. 14, 284 (1962)); r is the axis ratio for a spheroid alone.
struct JefferyOrbit {
  double r;
  double period() const;  ///< of a whole turn, 2 pi (r + 1/r), in units of 1/shear rate
};

/// Of a body of revolution about z, from the rates at which it turns with its axis along the
/// gradient and along the flow, r^2 being their ratio. Single layer of regularised Stokeslets on
/// the vertices (Cortez, Fauci, Medovikov, Phys. Fluids 17, 031504 (2005)) that move as a rigid
/// body without force and torque. The error of r falls with the first power of the vertex spacing.
/// Cost: a dense system of 3 n_v + 6 unknowns, 2 s at 642 vertices.
JefferyOrbit rigid_orbit(const membrane::TriangleMesh& mesh);

/// The same, extrapolated linearly in the spacing of a coarse and a fine mesh of one body.
JefferyOrbit rigid_orbit(const membrane::TriangleMesh& coarse, const membrane::TriangleMesh& fine);

}  // namespace hemomag::app
