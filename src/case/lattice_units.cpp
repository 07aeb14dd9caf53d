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
  const double nu = (n.tau - 0.5) / 3;
  LatticeUnits units;
  units.dx = n.dx;
  if (n.dt) {
    units.dt = *n.dt;
    units.density = c.fluid.viscosity * units.dt / (nu * n.dx * n.dx);
    return units;
  }
  units.density = n.cell_reynolds ? *n.cell_reynolds * c.fluid.viscosity /
                                        (c.channel.shear_rate * cell_radius * cell_radius)
                                  : c.fluid.density;
  units.dt = nu * n.dx * n.dx * units.density / c.fluid.viscosity;
  return units;
}

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
  return std::max(1L, std::lround(interval / units.dt));
}

long steps(const Case& c) {
  return c.run.steps ? *c.run.steps : steps_in(*c.run.time, lattice_units(c));
}

double susceptible_volume(const Carrier& carrier) {
  return carrier.susceptibility * carrier.magnetic_fraction * 4.0 / 3 * std::numbers::pi *
         std::pow(carrier.radius, 3);
}

GradientField gradient_field(const Case& c) {
  const auto& m = c.magnetic;
  const auto axis = static_cast<std::size_t>(m.axis);
  if (m.gradient) return {*m.gradient, m.zero_at[axis]};
  return {m.B0 / c.channel.size[axis], c.channel.size[axis]};
}

double strongest_field(const Case& c) {
  if (c.magnetic.field == FieldKind::none) return 0;
  if (c.magnetic.field == FieldKind::uniform) return std::fabs(c.magnetic.B0);
  const auto g = gradient_field(c);
  const double length = c.channel.size[static_cast<std::size_t>(c.magnetic.axis)];
  return std::fabs(g.slope) * std::max(std::fabs(g.zero), std::fabs(length - g.zero));
}

double stokes_friction(const Case& c, const Carrier& carrier) {
  return 6 * std::numbers::pi * c.fluid.viscosity * carrier.radius;
}

double point_radius(const Case& c) {
  const fluid::Relaxation relaxation = c.numerics.scheme == "bgk"
                                           ? fluid::Relaxation::bgk(c.numerics.tau)
                                           : fluid::Relaxation{c.numerics.tau, 3.0 / 16};
  return ibm::hydrodynamic_radius(ibm::delta_kernel(c.numerics.kernel), relaxation.magic) *
         c.numerics.dx;
}

double bare_friction(const Case& c, const Carrier& carrier) {
  return carrier.feedback ? stokes_friction(c, carrier) / (1 - carrier.radius / point_radius(c))
                          : stokes_friction(c, carrier);
}

}  // namespace hemomag::case_
