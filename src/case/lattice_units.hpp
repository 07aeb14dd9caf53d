#pragma once
#include <array>

#include "case/case.hpp"

namespace hemomag::case_ {

inline constexpr double vacuum_permeability = 1.25663706212e-6;  ///< mu* [N/A2]
inline constexpr double kBT = 4.14e-21;                          ///< thermal energy of Table 1 [J]
inline constexpr double cell_diameter = 7.82e-6;                 ///< D0 of Eq. 13 [m]
inline constexpr double cell_radius = 3.91e-6;                   ///< R in cell_reynolds [m]

/// What one lattice unit is in SI. Below the case front-end dx = dt = density = mu* = 1.
struct LatticeUnits {
  double dx = 0;       ///< [m]
  double dt = 0;       ///< [s]
  double density = 0;  ///< [kg/m3]; the fluid's own times the inertia scaling

  double mass() const { return density * dx * dx * dx; }
  double velocity() const { return dx / dt; }
  double tension() const { return mass() / (dt * dt); }     ///< [N/m]
  double force() const { return tension() * dx; }           ///< [N]
  double energy() const { return force() * dx; }            ///< [J]
  double pressure() const { return tension() / dx; }        ///< [Pa]
  double force_density() const { return pressure() / dx; }  ///< [N/m3]
  double magnetic_field() const;                            ///< [T], so that mu* = 1
};

/// The units of a case. tau and dx leave one freedom, fixed by dt, by cell_reynolds (rho = Re
/// mu/(shear R^2)), or by the real density: dt = nu_l dx^2 rho/mu, where nu_l = (tau - 1/2)/3, or
/// tau/3 in the exponential scheme.
LatticeUnits lattice_units(const Case& c);

/// Width of the channel across the flow [m]: the diameter of a tube, the distance of plates, or the
/// smallest side of the box.
double width(const Case& c);

/// The shear rate of cell_reynolds [1/s]: that of the plates, or the pseudo shear rate
/// mean_velocity/width; zero when neither is given.
double nominal_shear_rate(const Case& c);

/// Body force density along the flow's axis with which a run begins [N/m3]: the case's, or for a
/// mean velocity that of plasma alone between plates (12 mu u/H^2) or in a tube (8 mu u/R^2), in
/// voxels in a tube of the radius of the widest place.
double starting_force(const Case& c);

/// Estimate of the fastest flow [m/s]: of the plates, and of plasma alone under that force, 3/2 of
/// the mean between plates and twice the mean in a tube or voxels.
double fastest_flow(const Case& c);

/// Lattice units per unit of the surface file.
double surface_scale(const Case& c);

/// Nodes along each axis; the reader has made sure that size/dx is whole.
std::array<int, 3> nodes(const Case& c);

/// Velocity of the lower and upper plate along y [m/s].
std::array<double, 2> plate_velocity(const Case& c);

/// LAMMPS counts the steps of a run in an int.
inline constexpr long most_steps = 2147483647;

/// Steps of the run, and of an interval of simulated time [s] (at least one, at most `most_steps`).
long steps(const Case& c);
long steps_in(double interval, const LatticeUnits& units);

/// V_c of a carrier bead [m3], and chi V_c (Eq. 22).
double magnetic_volume(const Carrier& carrier);
double susceptible_volume(const Carrier& carrier);

/// Hydrodynamic radius of a coupled point [m]; a carrier that is felt must be smaller.
double point_radius(const Case& c);

/// Friction of a carrier bead [kg/s]: 6 pi mu a, and the bare one that the coupled scheme uses.
double stokes_friction(const Case& c, const Carrier& carrier);
double bare_friction(const Case& c, const Carrier& carrier);

/// Mass with which a carrier bead resists acceleration [kg], scaled like the fluid's density; zero
/// without a density. With feedback the displaced fluid is part of the lattice and moves along:
/// what counts is the excess mass. One-way it is the whole mass.
double inertial_mass(const Case& c, const Carrier& carrier);

}  // namespace hemomag::case_
