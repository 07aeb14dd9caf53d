#pragma once
#include <cmath>

namespace hemomag::contact {

/// Morse attraction between the membranes of two cells (Eq. 39), cut at `cutoff` without a shift,
/// as printed.
struct Morse {
  double depth = 0;  ///< D0 [energy]
  double beta = 0;   ///< [1/length]
  double r0 = 0;     ///< distance of the minimum
  double cutoff = 0;
};

/// -dU/dr: positive pushes apart.
inline double force(const Morse& m, double r) {
  const double q = std::exp(-m.beta * (r - m.r0));
  return 2 * m.depth * m.beta * (q * q - q);
}

inline double energy(const Morse& m, double r) {
  const double q = std::exp(-m.beta * (r - m.r0));
  return m.depth * (q * q - 2 * q);
}

}  // namespace hemomag::contact
