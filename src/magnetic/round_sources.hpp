#pragma once
#include "magnetic/frame.hpp"

// Sources with an axis of revolution, the third of their frame, and a straight wire.

namespace hemomag::magnetic {

/// Circular loop of a thin wire. Exact, by complete elliptic integrals: with c = I a/4 pi (mu* = 1)
///   B_rho = c zeta int cos phi/r^3,   B_z = c int (a - rho cos phi)/r^3,
/// r the distance from the ring at the angle phi, zeta the height above it.
struct CurrentLoop {
  Frame frame;
  double radius;
  double current;  ///< times turns; positive: counter-clockwise seen from the tip of the axis

  FieldAt operator()(const Vec3& x) const;
  Vec3 nearest(const Vec3& x) const;  ///< point of the wire nearest to x
};

/// Cylinder magnetised along its axis; the field outside it. The surface current J/mu* around its
/// side is a stack of loops, and its sum over the height is exact too (Derby & Olbert, Am. J. Phys.
/// 78:229, 2010); its derivative along the axis is the difference of the loops at the two ends.
struct CylinderMagnet {
  Frame frame;
  double radius;
  double half;       ///< half the length
  double remanence;  ///< J = mu* M, along the axis

  FieldAt operator()(const Vec3& x) const;
  Vec3 nearest(const Vec3& x) const;  ///< point of the body nearest to x
};

/// Straight wire without ends, B = I/(2 pi d^2) e x d, d from the wire.
struct StraightWire {
  Frame frame;
  double current;  ///< along the axis

  FieldAt operator()(const Vec3& x) const;
  Vec3 nearest(const Vec3& x) const;  ///< point of the wire nearest to x
};

}  // namespace hemomag::magnetic
