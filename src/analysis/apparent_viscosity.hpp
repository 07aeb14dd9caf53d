#pragma once
#include <array>

#include "base/vec3.hpp"

namespace hemomag::analysis {

/// Flow between plates at z = 0 and z = height, all along one axis; any consistent units.
struct PlateFlow {
  std::array<double, 2> drag{};         ///< on the lower and the upper plate, per area
  std::array<double, 2> plate_speed{};  ///< of the lower and the upper plate
  double height = 0;
  double mean_velocity = 0;  ///< over the channel
};

/// Shear stress of plates that move against each other: the mean of what the lower plate feels and
/// what the upper one resists. In a steady mean the two are equal.
inline double shear_stress(const PlateFlow& f) { return 0.5 * (f.drag[0] - f.drag[1]); }

/// Viscosity of the uniform fluid with that stress between plates that move against each other:
/// stress over (U_upper - U_lower)/H.
inline double apparent_viscosity_couette(const PlateFlow& f) {
  return shear_stress(f) * f.height / (f.plate_speed[1] - f.plate_speed[0]);
}

/// Viscosity of the uniform fluid that a force drives past resting plates at the same mean velocity
/// with the same drag: tau_w = 6 eta u/H, tau_w the mean of the two plates.
inline double apparent_viscosity_poiseuille(const PlateFlow& f) {
  return 0.5 * (f.drag[0] + f.drag[1]) * f.height / (6 * f.mean_velocity);
}

}  // namespace hemomag::analysis
