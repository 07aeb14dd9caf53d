#include "case/lattice_units.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fluid/relaxation.hpp"
#include "ibm/delta_kernel.hpp"

namespace hemomag::case_ {

double LatticeUnits::magnetic_field() const { return std::sqrt(vacuum_permeability * pressure()); }

LatticeUnits lattice_units(const Case& c) {
  const auto& n = c.numerics;
  const double nu = (n.scheme == "exponential" ? n.tau : n.tau - 0.5) / 3;
  LatticeUnits units;
  units.dx = n.dx;
  if (n.dt) {
    units.dt = *n.dt;
    units.density = c.fluid.viscosity * units.dt / (nu * n.dx * n.dx);
    return units;
  }
  units.density = n.cell_reynolds ? *n.cell_reynolds * c.fluid.viscosity /
                                        (nominal_shear_rate(c) * cell_radius * cell_radius)
                                  : c.fluid.density;
  units.dt = nu * n.dx * n.dx * units.density / c.fluid.viscosity;
  return units;
}

double width(const Case& c) {
  const auto& s = c.channel.size;
  if (c.channel.boundary == Boundary::tube) return c.channel.diameter;
  if (c.channel.boundary == Boundary::plates) return s[2];
  return *std::min_element(s.begin(), s.end());
}

double nominal_shear_rate(const Case& c) {
  if (c.channel.mean_velocity) return *c.channel.mean_velocity / width(c);
  return c.channel.shear_rate;
}

namespace {

/// k of the mean velocity u = k g/mu of plasma in a straight channel under the force density g
/// [m2]: H^2/12 between plates, R^2/8 in a tube.
double conductance(const Case& c) {
  if (c.channel.boundary == Boundary::plates) return std::pow(width(c), 2) / 12;
  const double radius = c.channel.boundary == Boundary::tube ? c.channel.diameter / 2
                                                             : c.vessel.widest * c.numerics.dx;
  return radius * radius / 8;
}

}  // namespace

double starting_force(const Case& c) {
  if (c.channel.mean_velocity) return *c.channel.mean_velocity * c.fluid.viscosity / conductance(c);
  return c.channel.body_force[static_cast<std::size_t>(c.channel.axis)];
}

double fastest_flow(const Case& c) {
  if (c.channel.boundary == Boundary::periodic) return 0;
  const auto v = plate_velocity(c);
  const double mean = std::fabs(starting_force(c)) * conductance(c) / c.fluid.viscosity;
  const double peak_over_mean = c.channel.boundary == Boundary::plates ? 1.5 : 2;
  return std::max(std::fabs(v[0]), std::fabs(v[1])) + peak_over_mean * mean;
}

double surface_scale(const Case& c) { return c.channel.geometry_unit / c.numerics.dx; }

std::array<int, 3> nodes(const Case& c) {
  std::array<int, 3> n{};
  for (std::size_t d = 0; d < 3; ++d)
    n[d] = static_cast<int>(std::lround(c.channel.size[d] / c.numerics.dx));
  return n;
}

std::array<double, 2> plate_velocity(const Case& c) {
  if (c.channel.boundary != Boundary::plates) return {0, 0};
  const double difference = c.channel.shear_rate * c.channel.size[2];
  if (c.channel.plates == Plates::lower_rest) return {0, difference};
  return {-difference / 2, difference / 2};
}

long steps_in(double interval, const LatticeUnits& units) {
  return std::max(1L, std::lround(std::min(interval / units.dt, 1.0 * most_steps)));
}

long steps(const Case& c) {
  return c.run.steps ? *c.run.steps : steps_in(*c.run.time, lattice_units(c));
}

double magnetic_volume(const Carrier& carrier) {
  return carrier.magnetic_fraction * 4.0 / 3 * std::numbers::pi * std::pow(carrier.radius, 3);
}

double susceptible_volume(const Carrier& carrier) {
  return carrier.susceptibility * magnetic_volume(carrier);
}

double stokes_friction(const Case& c, const Carrier& carrier) {
  return 6 * std::numbers::pi * c.fluid.viscosity * carrier.radius;
}

double point_radius(const Case& c) {
  const auto kernel = ibm::delta_kernel(c.numerics.kernel);
  if (c.numerics.scheme == "exponential")
    return ibm::exponential_radius(kernel, c.numerics.tau) * c.numerics.dx;
  const fluid::Relaxation relaxation = c.numerics.scheme == "bgk"
                                           ? fluid::Relaxation::bgk(c.numerics.tau)
                                           : fluid::Relaxation{c.numerics.tau, 3.0 / 16};
  return ibm::hydrodynamic_radius(kernel, relaxation.magic) * c.numerics.dx;
}

double bare_friction(const Case& c, const Carrier& carrier) {
  return carrier.feedback ? stokes_friction(c, carrier) / (1 - carrier.radius / point_radius(c))
                          : stokes_friction(c, carrier);
}

double inertial_mass(const Case& c, const Carrier& carrier) {
  if (!carrier.density) return 0;
  const double excess = *carrier.density - (carrier.feedback ? c.fluid.density : 0);
  const double scaling = lattice_units(c).density / c.fluid.density;
  return scaling * excess * 4.0 / 3 * std::numbers::pi * std::pow(carrier.radius, 3);
}

}  // namespace hemomag::case_
