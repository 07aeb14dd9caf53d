#pragma once
#include <string>

#include "lattice/surface.hpp"

namespace hemomag::lattice {

/// Points nearer to each other than this fraction of the bounding box's diagonal are one point to
/// `weld`. Single precision, in which most surfaces are stored, resolves 1e-7.
constexpr double weld_distance = 1e-6;

/// Join the points that coincide, exactly or within `weld_distance`: each goes to the first such
/// point of the list. The order of first appearances is kept; no triangle is removed.
/// @param name  of the surface, for messages
/// @throws Error for coordinates that are not finite and corners that are not points
void weld(Surface& surface, const std::string& name);

/// The surface as one that has an inside: every edge is shared by exactly two triangles that run
/// along it in opposite senses, and the signed volume is positive.
///
/// Triangles with a repeated corner are removed. A triangle of no area whose corner m lies on the
/// edge ab it shares with abd goes too, and abd becomes amd and mbd: same shape, still closed.
///        d                d
///      /   \            / | \             .
///     a --m-- b   ->   a--m--b
/// An inward surface is turned. Points that no triangle uses are removed; the others keep their
/// order. Not looked for: triangles that cut each other, and parts of the surface that only touch
/// at a point.
/// @param name  of the surface, for messages
/// @throws Error that says how many edges are at fault and where one is; also for coordinates that
/// are not finite, corners that are not points and a surface that encloses nothing
Surface closed(Surface surface, const std::string& name);

}  // namespace hemomag::lattice
