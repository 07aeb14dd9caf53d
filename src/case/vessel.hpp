#pragma once
#include <array>
#include <memory>
#include <string>

#include "base/vec3.hpp"

namespace hemomag::lattice {
class Vessel;
}

namespace hemomag::case_ {

struct Case;

/// The vessel of a case with a tube or voxels, and what the grid makes of it. Lattice units.
struct VesselOnGrid {
  std::shared_ptr<const lattice::Vessel> wall;  ///< empty between plates and without walls

  // Of voxels alone; a tube needs no counting.
  long fluid_nodes = 0;  ///< node centres in the fluid
  double widest = 0;     ///< largest distance from the wall that was met, to a third too small
  std::array<long, 3> open{};       ///< opposite face nodes along an axis that are both fluid
  std::array<long, 3> unmatched{};  ///< fluid nodes on a face that meet solid on the opposite one
};

/// Build the vessel of a case: a tube whose axis runs through the middle of the box, or the surface
/// of channel.geometry, whose file has its origin in the box's corner.
/// @throws Error when the surface cannot be read, is not closed, or holds no node
VesselOnGrid make_vessel(const Case& c);

/// Name of the surface file in the run directory, "geometry" with the original's ending; empty
/// without one.
std::string geometry_copy(const Case& c);

/// Volume of the fluid [m3]: of the tube, of the voxels, or of the box.
double fluid_volume(const Case& c);

/// Distance of a point [m] from the wall of the vessel [m], for cases that have one. The point may
/// lie outside the box by periods of it.
double wall_distance(const Case& c, Vec3 x);

}  // namespace hemomag::case_
