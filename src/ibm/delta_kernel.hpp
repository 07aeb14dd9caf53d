#pragma once
#include <string>
#include <string_view>

#include "base/error.hpp"

// Smoothed one-dimensional delta functions of the immersed boundary method; the three-dimensional
// one is their product (Eq. 30). A point at x touches the four nodes first .. first + 3 with first
// = floor(x - 1/2) - 1, and r = x - 1/2 - floor(x - 1/2) in [0, 1) is its distance from the second
// of them. Narrower kernels give the outer nodes the weight zero, so that one transfer loop serves
// all of them.

namespace hemomag::ibm {

enum class DeltaKernel {
  cosine4,  ///< Eq. 31: (1 + cos(pi r/2))/4
  peskin4,  ///< Peskin, Acta Numerica 11:479 (2002), Eq. 6.27: also conserves the first moment
  roma3,    ///< Roma, Peskin & Berger, J. Comput. Phys. 153:509 (1999): three nodes, first moment
  linear2,  ///< 1 - |r|, trilinear interpolation: two nodes, first moment
};

/// Parse a kernel's name. @throws Error naming the accepted ones.
inline DeltaKernel delta_kernel(std::string_view name) {
  if (name == "cosine4") return DeltaKernel::cosine4;
  if (name == "peskin4") return DeltaKernel::peskin4;
  if (name == "roma3") return DeltaKernel::roma3;
  if (name == "linear2") return DeltaKernel::linear2;
  throw Error("kernel = " + std::string(name) +
              " is unknown; accepted: cosine4, peskin4, roma3, linear2");
}

/// R at x, with 1/R, the mobility, linear between the points of a table and continued beyond its
/// last.
inline double inverse_linear(const double* at, const double* R, int points, double x) {
  int k = 0;
  while (k < points - 2 && x > at[k + 1]) ++k;
  const double share = (x - at[k]) / (at[k + 1] - at[k]);
  return 1 / ((1 - share) / R[k] + share / R[k + 1]);
}

/// Hydrodynamic radius R of a point coupled by the kernel, in node spacings: the mobility of a
/// driven point is 1/(6 pi mu R) more than its bare one (Ahlrichs & Duenweg, J. Chem. Phys.
/// 111:8225, 1999). For TRT and BGK it depends on Lambda = (tau - 1/2)(tau_minus - 1/2) alone, not
/// on the viscosity.
///
/// Measured with the fluid of src/solver in a periodic box of 24 nodes, corrected after Hasimoto
/// (J. Fluid Mech. 5:317, 1959): R of the mobility's mean over the cell, that of points at all
/// places alike (tests/support/point_radius.hpp; all numbers again by
/// build/tests/point_radius_table). R changes with the place in the cell, at Lambda = 3/16 from a
/// node to a cell's centre: cosine4 and peskin4 from 1.345 to 1.365, roma3 from 1.051 to 1.002,
/// linear2 from 0.405 to 1.002, so that with linear2 the mobility of a point changes more than
/// twofold on its way.
///
/// Between the points 1/R, the mobility, is linear in sqrt(Lambda), to half a per cent. Beyond the
/// last it is continued: R is then 6 to 8 % too large at sqrt(Lambda) = 5.
/// @param magic  Lambda  > 0
inline double hydrodynamic_radius(DeltaKernel kernel, double magic) {
  constexpr int points = 12;
  constexpr double root[points] = {0.02, 0.05, 0.1, 0.2, 0.3, 0.4330127018922193,
                                   0.5,  0.75, 1.0, 1.5, 2.0, 3.0};
  constexpr double radius[4][points] = {
      // cosine4, peskin4, roma3, linear2
      {1.479, 1.477, 1.469, 1.444, 1.409, 1.356, 1.327, 1.217, 1.114, 0.939, 0.802, 0.608},
      {1.480, 1.478, 1.470, 1.445, 1.410, 1.356, 1.327, 1.218, 1.115, 0.939, 0.802, 0.608},
      {1.216, 1.211, 1.196, 1.153, 1.102, 1.030, 0.995, 0.875, 0.773, 0.620, 0.512, 0.374},
      {1.017, 1.008, 0.982, 0.914, 0.844, 0.758, 0.719, 0.599, 0.509, 0.387, 0.311, 0.219},
  };
  return inverse_linear(root, radius[static_cast<int>(kernel)], points, __builtin_sqrt(magic));
}

/// The same in the exponential scheme, where R depends on tau. Measured likewise, in a box of 16
/// nodes; below the first point R hardly changes.
/// @param tau  3 nu  > 0
inline double exponential_radius(DeltaKernel kernel, double tau) {
  constexpr int points = 11;
  constexpr double at[points] = {0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0};
  constexpr double radius[4][points] = {
      // cosine4, peskin4, roma3, linear2
      {1.238, 1.239, 1.237, 1.222, 1.169, 1.088, 1.007, 0.857, 0.732, 0.627, 0.539},
      {1.239, 1.239, 1.237, 1.222, 1.169, 1.089, 1.007, 0.858, 0.732, 0.627, 0.539},
      {0.885, 0.882, 0.877, 0.859, 0.804, 0.727, 0.655, 0.537, 0.447, 0.376, 0.319},
      {0.597, 0.587, 0.578, 0.561, 0.512, 0.449, 0.395, 0.313, 0.255, 0.212, 0.179},
  };
  return inverse_linear(at, radius[static_cast<int>(kernel)], points, tau > at[0] ? tau : at[0]);
}

/// Nodes beyond a point's own that a kernel reaches.
inline constexpr int kernel_reach = 2;

/// Sine and cosine of pi r/2 for r in [0, 1], by the half angle and Taylor series that are exact to
/// rounding on [0, pi/4]; free of calls, so that loops over it vectorise.
[[gnu::always_inline]] inline void quarter_wave(double r, double& sine, double& cosine) {
  const double t = r * 0.78539816339744830962;  // pi r / 4
  const double q = t * t;
  const double s =
      t * (1 + q * (-1.0 / 6 +
                    q * (1.0 / 120 +
                         q * (-1.0 / 5040 +
                              q * (1.0 / 362880 +
                                   q * (-1.0 / 39916800 + q * (1.0 / 6227020800.0 -
                                                               q * (1.0 / 1307674368000.0))))))));
  const double c =
      1 + q * (-1.0 / 2 +
               q * (1.0 / 24 +
                    q * (-1.0 / 720 + q * (1.0 / 40320 + q * (-1.0 / 3628800 +
                                                              q * (1.0 / 479001600.0 -
                                                                   q * (1.0 / 87178291200.0)))))));
  sine = 2 * s * c;
  cosine = 1 - 2 * s * s;
}

/// Weights of the four nodes, at distances 1 + r, r, 1 - r and 2 - r. They sum to one.
[[gnu::always_inline]] inline void kernel_weights(DeltaKernel kernel, double r,
                                                  double (&weight)[4]) {
  if (kernel == DeltaKernel::cosine4) {
    double s, c;
    quarter_wave(r, s, c);
    weight[0] = 0.25 * (1 - s);
    weight[1] = 0.25 * (1 + c);
    weight[2] = 0.25 * (1 + s);
    weight[3] = 0.25 * (1 - c);
  } else if (kernel == DeltaKernel::peskin4) {
    const double root = __builtin_sqrt(1 + 4 * r * (1 - r));
    weight[0] = 0.125 * (3 - 2 * r - root);
    weight[1] = 0.125 * (3 - 2 * r + root);
    weight[2] = 0.125 * (1 + 2 * r + root);
    weight[3] = 0.125 * (1 + 2 * r - root);
  } else if (kernel == DeltaKernel::roma3) {
    // The nearest node is the second or the third, and s in [-1/2, 1/2] the distance from it.
    // Factors of one and zero choose, since a branch would be mispredicted for every other point.
    const double third = r < 0.5 ? 0 : 1, second = 1 - third;
    const double s = r - third;
    const double root = __builtin_sqrt(1 - 3 * s * s);
    const double before = (2 - 3 * s - root) * (1.0 / 6), after = (2 + 3 * s - root) * (1.0 / 6);
    const double nearest = (1 + root) * (1.0 / 3);
    weight[0] = second * before;
    weight[1] = second * nearest + third * before;
    weight[2] = second * after + third * nearest;
    weight[3] = third * after;
  } else {
    weight[0] = weight[3] = 0;
    weight[1] = 1 - r;
    weight[2] = r;
  }
}

}  // namespace hemomag::ibm
