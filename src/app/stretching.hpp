#pragma once
#include <string>
#include <vector>

#include "membrane/whole_cell.hpp"

// Stretching a red cell between two opposite end loads, without a fluid: the state is the minimum
// of the membrane's energy under that load (quasi-static, no thermal noise).
// Units: um and pN, so that 1e-6 N/m = 1 pN/um and 1e-18 J = 1 pN um.

namespace hemomag::app {

/// Table 1 of Ye, Shen & Li (2018) in um and pN.
inline membrane::Moduli table_1() {
  return {.mu0 = 6.3, .k_a = 4.72, .k_d = 231, .k_v = 249, .k_b = 0.5};
}
inline constexpr double rest_diameter = 7.82;  ///< D0 of Eq. 13 [um]

/// The vertices that are pulled: a fraction of all at each end, outermost in x at rest.
struct Grips {
  std::vector<int> low, high;
};
Grips grips(const std::vector<Vec3>& rest, double fraction);

/// Turn about z, in the plane of the disc.
std::vector<Vec3> turned(std::vector<Vec3> x, double degrees);

/// A stretched cell.
struct Stretched {
  double force = 0;                  ///< at each end [pN]
  double D_A = 0, D_T = 0, D_z = 0;  ///< extents along x (axial), y (transverse) and z [um]
  double area_change = 0, volume_change = 0;  ///< relative
  double extension = 0;                       ///< longest edge over its l_max
  double residual = 0;                        ///< largest force left on a vertex [pN]
  std::vector<Vec3> x;                        ///< vertices [um]
};

struct StretchOptions {
  double fraction = 0.02;  ///< of the vertices held at each end
  double direction = 0;    ///< of the pull in the plane of the disc [degrees]
};

/// Extents and changes of a state.
Stretched measure(const membrane::WholeCell& network, const std::vector<Vec3>& x, double force);

/// Equilibria under rising forces [pN].
/// @throws hemomag::Error when the minimiser does not reach 1e-3 pN a vertex
std::vector<Stretched> stretch(const membrane::TriangleMesh& mesh, const membrane::Moduli& moduli,
                               const std::vector<double>& forces, const StretchOptions& options);

}  // namespace hemomag::app
