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

/// Hydrodynamic radius of a point coupled by the kernel, in node spacings: the mobility of a driven
/// point is 1/(6 pi mu R) more than its bare one (Ahlrichs & Duenweg, J. Chem. Phys. 111:8225,
/// 1999). It depends on the collision's Lambda = (tau - 1/2)(tau_minus - 1/2) alone; measured in
/// periodic boxes over offsets at six values, linear between them in sqrt(Lambda) (to half a per
/// cent), 1.356 at the default 3/16. Both four-point kernels have the same.
inline double hydrodynamic_radius(DeltaKernel, double magic) {
  constexpr double root[] = {0.1, 0.3, 0.4330127018922193, 0.5, 1.0, 1.5};
  constexpr double radius[] = {1.470, 1.410, 1.356, 1.326, 1.114, 0.939};
  const double at = __builtin_sqrt(magic);
  int k = 0;
  while (k < 4 && at > root[k + 1]) ++k;
  return radius[k] + (radius[k + 1] - radius[k]) * (at - root[k]) / (root[k + 1] - root[k]);
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
