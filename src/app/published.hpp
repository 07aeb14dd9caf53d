#pragma once
#include <array>

#include "base/error.hpp"

// Measurements and simulations that validations compare with, digitised.

namespace hemomag::app {

/// Red cells between optical tweezers, mean and standard deviation [um] at a force [pN]:
/// Mills, Qie, Dao, Lim, Suresh, Mech. Chem. Biosyst. 1, 169 (2004).
struct MillsPoint {
  double force, D_A, sd_A, D_T, sd_T;
};
inline constexpr std::array<MillsPoint, 13> mills_2004{{
    {0, 7.747, 0.549, 7.692, 0.549},
    {15.73, 9.231, 0.769, 6.703, 0.659},
    {19.23, 9.670, 0.824, 6.484, 0.604},
    {30.42, 10.000, 1.044, 6.099, 0.659},
    {38.11, 10.824, 1.154, 5.934, 0.824},
    {47.20, 11.264, 1.429, 5.440, 0.989},
    {67.83, 12.253, 1.484, 4.945, 0.989},
    {87.76, 13.022, 1.813, 4.725, 1.044},
    {109.09, 13.681, 1.703, 4.505, 1.044},
    {130.77, 14.011, 1.978, 4.505, 0.989},
    {151.05, 14.505, 2.088, 4.505, 0.934},
    {172.38, 14.780, 2.143, 4.505, 0.879},
    {192.31, 15.165, 2.253, 4.286, 0.879},
}};

/// Simulated stretching curve of Fedosov, Caswell, Karniadakis, Biophys. J. 98, 2215 (2010) [pN,
/// um].
struct FedosovPoint {
  double force, D_T, D_A;
};
inline constexpr std::array<FedosovPoint, 15> fedosov_2010{{
    {13.296, 7.262, 9.263},
    {26.445, 6.769, 10.347},
    {39.870, 6.373, 11.316},
    {53.066, 6.031, 12.166},
    {66.410, 5.748, 12.860},
    {80.003, 5.532, 13.465},
    {93.492, 5.345, 13.943},
    {106.728, 5.177, 14.368},
    {119.888, 5.036, 14.758},
    {133.404, 4.896, 15.077},
    {146.545, 4.774, 15.347},
    {160.002, 4.694, 15.607},
    {173.312, 4.596, 15.837},
    {186.985, 4.506, 16.033},
    {199.995, 4.450, 16.236},
}};

/// Quasi-static stretching of the authors' own mesh of 3286 vertices, constants of Table 1, 2 % of
/// the vertices held at each end, from an independent minimiser of this project [pN, um].
struct QuasiStaticPoint {
  double force, D_A, D_T;
};
inline constexpr std::array<QuasiStaticPoint, 5> authors_mesh{{
    {25, 9.8866, 6.9640},
    {50, 11.2685, 6.3929},
    {100, 13.4090, 5.6989},
    {150, 14.8103, 5.3152},
    {200, 15.7720, 5.0520},
}};

/// Length over width of a red cell let go after a stretch, against time [s]:
/// Hochmuth, Worthy, Evans, Biophys. J. 26, 101 (1979), first set.
struct RecoveryPoint {
  double time, ratio;
};
inline constexpr std::array<RecoveryPoint, 10> hochmuth_1979{{
    {0.0005, 2.005},
    {0.032, 1.732},
    {0.065, 1.525},
    {0.0985, 1.396},
    {0.149, 1.310},
    {0.201, 1.241},
    {0.249, 1.184},
    {0.300, 1.157},
    {0.350, 1.130},
    {0.397, 1.112},
}};

/// Tank-treading frequency over shear rate, means over shear-rate bins of 225 single cells in a
/// fluid of 28.9 mPa s: Fischer & Korzeniewski 2015, Fig. S11 [1/s, -].
struct TreadingPoint {
  double shear_rate, frequency_over_shear;
};
inline constexpr double fischer_2015_viscosity = 28.9e-3;  ///< [Pa s]
inline constexpr std::array<TreadingPoint, 6> fischer_2015{{
    {8.21, 0.0398},
    {16.88, 0.0368},
    {32.44, 0.0330},
    {65.17, 0.0287},
    {131.6, 0.0260},
    {258.0, 0.0254},
}};

/// Shear stress [Pa] at which tumbling gives way to tank-treading, by suspending viscosity [mPa s]:
/// Fischer & Korzeniewski, J. Fluid Mech. 736, 351 (2013); Abkarian, Faivre, Viallat, Phys. Rev.
/// Lett. 98, 188302 (2007).
struct ThresholdPoint {
  double viscosity, stress;
  const char* source;
};
inline constexpr std::array<ThresholdPoint, 10> tumbling_thresholds{{
    {10.7, 0.921, "Fischer & Korzeniewski 2013"},
    {10.7, 0.791, "Fischer & Korzeniewski 2013"},
    {10.7, 0.584, "Fischer & Korzeniewski 2013"},
    {23.9, 0.232, "Fischer & Korzeniewski 2013"},
    {23.9, 0.115, "Fischer & Korzeniewski 2013"},
    {23.9, 0.0634, "Fischer & Korzeniewski 2013"},
    {104, 0.0560, "Fischer & Korzeniewski 2013"},
    {104, 0.0592, "Fischer & Korzeniewski 2013"},
    {31.0, 0.0582, "Abkarian et al. 2007"},
    {31.0, 0.0467, "Abkarian et al. 2007"},
}};
/// Critical frequency of a magnetic chain of N touching spheres in a rotating field, as w = omega 6
/// pi eta a^2/F0 with F0 of Eq. 45: without hydrodynamic interaction, with that of Rotne, Prager
/// and Yamakawa and the soft repulsion of kappa 30 and 60 (own simulations, shared reference data),
/// and of a slender body whose torque just suffices, 0.28125 (N - 1)(ln(N/2) + 2.4/N)/N^3.
struct ChainPoint {
  int carriers;
  double free_draining, rpy_kappa30, rpy_kappa60, slender_body;
};
inline constexpr std::array<ChainPoint, 12> chain_breakup{{
    {2, 0.05202, 0.03014, 0.03258, 0.04219},
    {3, 0.02794, 0.02261, 0.02458, 0.02511},
    {4, 0.01495, 0.01625, 0.01757, 0.01705},
    {5, 0.01017, 0.01222, 0.01322, 0.01257},
    {6, 0.00691, 0.00913, 0.00987, 0.00976},
    {7, 0.00522, 0.00741, 0.00801, 0.00785},
    {8, 0.00395, 0.00600, 0.00649, 0.00648},
    {9, 0.00318, 0.00507, 0.00548, 0.00547},
    {10, 0.00254, 0.00425, 0.00462, 0.00468},
    {11, 0.00214, 0.00369, 0.00401, 0.00406},
    {13, 0.00153, 0.00284, 0.00309, 0.00316},
    {15, 0.00115, 0.00226, 0.00245, 0.00254},
}};

/// w of kappa 60. @throws Error without a row for N
inline double critical_frequency(int N) {
  for (const ChainPoint& p : chain_breakup)
    if (p.carriers == N) return p.rpy_kappa60;
  throw Error("no critical frequency for this number of carriers");
}

/// Apparent viscosity [mPa s] of whole blood at 37 C by shear rate [1/s] and hematocrit:
/// Wells, Merrill, J. Clin. Invest. 41, 1591 (1962). Their blood aggregates.
inline constexpr std::array<double, 5> wells_merrill_hematocrit{0.16, 0.33, 0.43, 0.57, 0.70};
struct WellsMerrillRow {
  double shear_rate;
  std::array<double, 5> viscosity;
};
inline constexpr std::array<WellsMerrillRow, 4> wells_merrill_1962{{
    {12.3, {2.19, 6.91, 11.11, 16.91, 21.96}},
    {24.4, {1.88, 5.63, 9.08, 12.49, 16.40}},
    {62, {1.47, 3.69, 6.81, 8.55, 11.14}},
    {123.6, {1.35, 3.06, 6.25, 7.80, 9.78}},
}};

}  // namespace hemomag::app
