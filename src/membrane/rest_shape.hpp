#pragma once
#include <array>

#include "base/vec3.hpp"

// The biconcave rest shape of a red cell, Eq. 13 of Ye, Shen & Li (2018), after Evans & Fung
// (1972):
//   z(r) = +- D0 sqrt(1 - 4 q) (c0 + c1 q + c2 q^2),   q = r^2/D0^2,   0 <= r <= D0/2
// Differs from Eq. 13: the print has d_0 for D0 in two places. With D0 as the prefactor throughout,
// D0 = 7.82 um gives 134.1 um^2 and 94.1 um^3; any other reading does not. The meridian is
// parametrised by an angle t in [0, pi], from the upper to the lower pole:
//   r = D0/2 sin t,   z = D0 cos t (c0 + c1 q + c2 q^2),   q = sin^2 t / 4
// which is smooth through the rim (t = pi/2), where z(r) has a vertical slope.
// Lengths are in the unit of `diameter`, whatever it is.
namespace hemomag::membrane {

inline constexpr std::array<double, 3> rest_shape_coefficients{0.0518, 2.0026, -4.491};

/// Half thickness at the distance `radius` from the axis (Eq. 13); zero beyond the rim.
double rest_height(double radius, double diameter);

/// Area of the smooth surface, by quadrature.
double rest_area(double diameter);

/// Volume inside the smooth surface: pi D0^3 (c0/3 + c1/30 + c2/210).
double rest_volume(double diameter);

/// Area of the part of the surface whose cos t is above `w`, over the whole; falls from 1 at w = -1
/// to 0 at w = 1.
double rest_area_fraction_above(double w);

/// The point of the surface at the meridian angle `t` and the azimuth `phi`.
Vec3 rest_point(double t, double phi, double diameter);

/// The point of the surface nearest to `p`, which must lie close to it. The result is on the
/// surface to round-off; it is the nearest one to about curvature x distance^4.
Vec3 project_to_rest_shape(const Vec3& p, double diameter);

}  // namespace hemomag::membrane
