#pragma once
#include "magnetic/frame.hpp"

namespace hemomag::magnetic {

/// Uniformly magnetised rectangular block, in any direction; the field outside it.
///
/// Its charge sheets give B_b = (1/4 pi) J_a N_ab with J the remanence and the symmetric tensor
///   N_zz = sum s atan(X Y/(Z R)),   N_xy = -sum s ln(Z + R),   and so on by exchange of axes,
/// over the eight corners, (X, Y, Z) from the corner to the place, R its length, s = +-1 the
/// product of the signs of the three faces (Akoun & Yonnet, IEEE Trans. Magn. 20:1962, 1984). The
/// derivatives need no more than corner terms 1/R and edge terms (Z/R)/(X^2 + Y^2). Written so that
/// it is regular on the planes of the faces and on the extensions of the edges; on an edge itself
/// the field is infinite.
struct BlockMagnet {
  Frame frame;
  Vec3 half;       ///< half the edges, along the frame's axes
  Vec3 remanence;  ///< J = mu* M, components along the frame's axes

  FieldAt operator()(const Vec3& x) const;
  Vec3 nearest(const Vec3& x) const;  ///< point of the body nearest to x
};

}  // namespace hemomag::magnetic
