#pragma once
#include <array>
#include <span>
#include <vector>

#include "membrane/mesh.hpp"

namespace hemomag::membrane {

/// Carries the deformation of a coarse mesh to a fine mesh of the same shape.
///
/// Every fine vertex has a place on the coarse mesh at rest, the nearest point of its triangles in
/// barycentric coordinates, and an offset from it, kept in a frame that turns with the coarse
/// mesh: the normal interpolated between the corners, and the direction of the triangle's first
/// edge across it. At rest the fine mesh comes out as it is; a rigid motion is carried exactly.
class MeshMap {
public:
  /// @param coarse, fine  at rest, about the same centre
  /// Cost: one distance a fine vertex and coarse triangle.
  MeshMap(const TriangleMesh& coarse, const TriangleMesh& fine);

  /// @param x  [n_v of the coarse mesh]
  /// @return   [n_v of the fine mesh]
  std::vector<Vec3> operator()(std::span<const Vec3> x) const;

private:
  struct Place {
    std::size_t triangle;
    std::array<double, 3> weight;
    Vec3 offset;  // along the frame's three axes
  };
  std::vector<std::array<int, 3>> triangles_;  // coarse
  std::vector<Place> places_;                  // of fine vertices
};

}  // namespace hemomag::membrane
