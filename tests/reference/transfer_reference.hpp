#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include "base/vec3.hpp"
#include "ibm/delta_kernel.hpp"

// Delta functions as their papers print them, one distance at a time, and the sum over all nodes.

namespace hemomag::reference {

/// The kernel at a distance d.
inline double delta(ibm::DeltaKernel kernel, double d) {
  d = std::fabs(d);
  switch (kernel) {
  case ibm::DeltaKernel::cosine4:  // Eq. 31
    return d < 2 ? 0.25 * (1 + std::cos(std::numbers::pi * d / 2)) : 0;
  case ibm::DeltaKernel::peskin4:  // Peskin 2002, Eq. 6.27
    return d < 1   ? (3 - 2 * d + std::sqrt(1 + 4 * d - 4 * d * d)) / 8
           : d < 2 ? (5 - 2 * d - std::sqrt(-7 + 12 * d - 4 * d * d)) / 8
                   : 0;
  case ibm::DeltaKernel::roma3:  // Roma, Peskin & Berger 1999
    return d < 0.5   ? (1 + std::sqrt(1 - 3 * d * d)) / 3
           : d < 1.5 ? (5 - 3 * d - std::sqrt(1 - 3 * (1 - d) * (1 - d))) / 6
                     : 0;
  case ibm::DeltaKernel::linear2:
    return d < 1 ? 1 - d : 0;
  }
  return NAN;
}

/// Visit the nodes within two spacings of a point: visit(node, weight).
/// @param x  position in the block's own coordinates, in which node i lies at i
template <class Visit> void for_each_weight(ibm::DeltaKernel kernel, const Vec3& x, Visit visit) {
  const int i0 = static_cast<int>(std::floor(x.x)), j0 = static_cast<int>(std::floor(x.y)),
            k0 = static_cast<int>(std::floor(x.z));
  for (int k = k0 - 1; k <= k0 + 2; ++k)
    for (int j = j0 - 1; j <= j0 + 2; ++j)
      for (int i = i0 - 1; i <= i0 + 2; ++i)
        visit(std::array<int, 3>{i, j, k},
              delta(kernel, x.x - i) * delta(kernel, x.y - j) * delta(kernel, x.z - k));
}

}  // namespace hemomag::reference
