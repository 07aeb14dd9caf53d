#pragma once
#include <cmath>

namespace hemomag::contact {

/// Repulsion of a wall on a point at the distance d from it: 4 eps [(sigma/d)^12 - (sigma/d)^6],
/// cut and shifted to zero at `cutoff` (LAMMPS's wall/lj126). With cutoff = 2^(1/6) sigma it is the
/// repulsive part alone. Beyond the cut-off both functions are zero.
struct WallRepulsion {
  double epsilon = 0;
  double sigma = 0;
  double cutoff = 0;
};

/// -dE/dd, from 0 < d: positive pushes away from the wall.
inline double force(const WallRepulsion& wall, double d) {
  if (d >= wall.cutoff) return 0;
  const double q6 = std::pow(wall.sigma / d, 6);
  return 24 * wall.epsilon * (2 * q6 * q6 - q6) / d;
}

inline double energy(const WallRepulsion& wall, double d) {
  if (d >= wall.cutoff) return 0;
  const double q6 = std::pow(wall.sigma / d, 6), c6 = std::pow(wall.sigma / wall.cutoff, 6);
  return 4 * wall.epsilon * ((q6 * q6 - q6) - (c6 * c6 - c6));
}

}  // namespace hemomag::contact
