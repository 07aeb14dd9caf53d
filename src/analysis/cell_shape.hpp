#pragma once
#include <array>

#include "base/vec3.hpp"

// The shape of one cell from its surface. The flow is along y, its gradient along z, so that the
// shear plane is (y, z); angles in it count from +y towards +z.

namespace hemomag::analysis {

/// Moments of the solid that a closed, outward oriented triangle mesh encloses, about the point
/// from which the corners are given: sums over the signed tetrahedra between that point and the
/// triangles. Sums of parts of one surface may be added.
struct SolidMoments {
  double area = 0;                 ///< of the surface
  double volume = 0;               ///< of the solid, integral of 1
  Vec3 first;                      ///< integral of x
  std::array<double, 6> second{};  ///< integral of x x^T: xx, yy, zz, yz, xz, xy

  /// Add the tetrahedron (0, a, b, c). With D = a . (b x c) and s = a + b + c its volume is D/6,
  /// its first moment D s/24 and its second D (a a^T + b b^T + c c^T + s s^T)/120 (the integrals of
  /// a linear and a quadratic function over a simplex, exact).
  void add(const Vec3& a, const Vec3& b, const Vec3& c);
};

/// Size, place and orientation of a solid. Lengths in the unit of the corners, angles in radians.
struct CellShape {
  double area, volume;
  Vec3 centre;  ///< of volume, from the point the moments are about
  /// Semi-axes a >= b >= c of the ellipsoid of equal moments: a^2 = 5 lambda_1 and so on, lambda
  /// the eigenvalues of the second central moments over the volume.
  std::array<double, 3> semi_axes;
  /// Unit vectors along a, b, c. Of the two opposite ones along an axis that with
  /// x + sqrt(2) y + sqrt(3) z > 0, a choice that no common orientation leaves open; b = c x a up
  /// to that sign.
  std::array<Vec3, 3> directions;
  double taylor;  ///< (a - c)/(a + c)
  /// (A - B)/(A + B) of the semi-axes A >= B, sqrt(5 lambda), of the moments within the shear
  /// plane. Equal to the Taylor deformation of an ellipsoid's outline when one of its axes is along
  /// x.
  double taylor_in_plane;
  /// Angle of A's direction from +y towards +z, in (-pi/2, pi/2].
  double inclination;
};

/// @pre the volume is positive
CellShape cell_shape(const SolidMoments& moments);

/// Of the angles that differ from `angle` by whole periods, the one nearest to `last`: counts turns
/// when the angle moves by less than half a period between calls.
double nearest_turn(double angle, double last, double period);

}  // namespace hemomag::analysis
