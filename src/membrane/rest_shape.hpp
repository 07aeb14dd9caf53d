#pragma once
#include <array>
#include <vector>

#include "base/vec3.hpp"

// Rest shapes of cells: bodies of revolution about z whose half thickness at the distance r from
// the axis is that of Eq. 13 of Ye, Shen & Li (2018), after Evans & Fung (1972):
//   z(r) = +- D sqrt(1 - 4 q) (c0 + c1 q + c2 q^2),   q = r^2/D^2,   0 <= r <= D/2
// Three numbers c make a red cell; c1 = c2 = 0 makes a spheroid of the thickness 2 c0 D, and
// c0 = 1/2 a sphere.
// Differs from Eq. 13: the print has d_0 for D0 in two places. With D0 as the prefactor throughout,
// D0 = 7.82 um gives 134.1 um^2 and 94.1 um^3; any other reading does not. The meridian is
// parametrised by an angle t in [0, pi], from the upper to the lower pole:
//   r = D/2 sin t,   z = D cos t (c0 + c1 q + c2 q^2),   q = sin^2 t / 4
// which is smooth through the rim (t = pi/2), where z(r) has a vertical slope.
// Lengths are in the unit of `diameter`, whatever it is.
namespace hemomag::membrane {

struct RestShape {
  double diameter;          ///< D                        > 0
  std::array<double, 3> c;  ///< thickness, over D        c0 + c1 q + c2 q^2 > 0 on the body
};

/// The biconcave cell of Eq. 13.
/// @param diameter  D0
constexpr RestShape red_cell_shape(double diameter) { return {diameter, {0.0518, 2.0026, -4.491}}; }

/// A spheroid, oblate when it is thinner than wide.
constexpr RestShape spheroid(double diameter, double thickness) {
  return {diameter, {0.5 * thickness / diameter, 0, 0}};
}

/// Half thickness at the distance `radius` from the axis (Eq. 13); zero beyond the rim.
double rest_height(const RestShape& shape, double radius);

/// Area of the smooth surface, by quadrature.
double rest_area(const RestShape& shape);

/// Volume inside the smooth surface: pi D^3 (c0/3 + c1/30 + c2/210).
double rest_volume(const RestShape& shape);

/// Area of the part of the surface whose cos t is above `w`, over the whole; falls from 1 at w = -1
/// to 0 at w = 1.
double rest_area_fraction_above(const RestShape& shape, double w);

/// The inverse of rest_area_fraction_above, by a table. Error in w: 1e-6 on a red cell.
class CosineOfAreaFraction {
public:
  explicit CosineOfAreaFraction(const RestShape& shape);
  /// @param fraction  in [0, 1]
  double operator()(double fraction) const;

private:
  std::vector<double> fraction_;  // above cos t = 1 - 2 k/rows
};

/// The point of the surface at the meridian angle `t` and the azimuth `phi`.
Vec3 rest_point(const RestShape& shape, double t, double phi);

/// Meridian angle of the point of the surface nearest to `p`, which must lie close to it. It is the
/// nearest one to about curvature x distance^4.
double meridian_angle(const RestShape& shape, const Vec3& p);

/// That nearest point; on the surface to round-off.
Vec3 project_to_rest_shape(const RestShape& shape, const Vec3& p);

}  // namespace hemomag::membrane
