#pragma once
#include <cstdint>

#include "lattice/surface.hpp"
#include "lattice/vessel.hpp"

namespace hemomag::lattice {

/// The inside of a closed triangulated surface.
///
/// The distance is that to the nearest triangle. Its sign is the side on which the point lies of
/// the angle-weighted pseudonormal of the nearest feature: the normal of a face, the sum of the
/// normals of the two faces of an edge, the sum of the normals of the faces at a vertex weighted
/// with their angles there (Baerentzen and Aanaes, IEEE TVCG 11:243, 2005, eqs. 3 and 4). The
/// nearest triangle is found in a tree of bounding boxes.
///
/// Queries do not change the object: threads may share it. A query costs a few microseconds for
/// 100,000 triangles; more where much of the surface is equally far, as at the centre of a sphere.
class SurfaceVessel : public Vessel {
public:
  /// @param surface  lattice units, the fluid inside
  /// @throws Error when the surface is not closed (`closed`, which also mends what it can)
  explicit SurfaceVessel(Surface surface);

  double distance(const Vec3& x) const override;

  /// The surface as it is used: closed, outward, without degenerate triangles.
  const Surface& surface() const { return surface_; }

private:
  struct Face {
    std::array<Vec3, 3> corner;
    Vec3 normal;                 // outward, unit
    std::array<Vec3, 3> inward;  // from edge (k, k+1) into the face, in its plane
  };

  /// The nearest point of a face, and what it belongs to.
  struct Nearest {
    double distance2;
    Vec3 offset;  // from the nearest point to the query
    std::size_t face;
    int feature;  // 0..2: edge (k, k+1); 3..5: corner k - 3; 6: the face
  };

  /// A box of the tree. Children of node i are i + 1 and `second`; a leaf has faces instead.
  struct Node {
    Vec3 low, high;
    std::uint32_t second;        // of an inner node
    std::uint32_t first, count;  // faces of a leaf; count is 0 for an inner node
  };

  void build_tree(std::size_t first, std::size_t last);
  void set_pseudonormals();
  void approach(std::size_t face, const Vec3& x, Nearest& nearest) const;
  const Vec3& pseudonormal(const Nearest& nearest) const;

  Surface surface_;                                // triangles in the order of the leaves
  std::vector<Face> faces_;                        // [triangle]
  std::vector<std::array<Vec3, 3>> edge_normals_;  // [triangle][edge (k, k+1)]
  std::vector<Vec3> vertex_normals_;               // [point]
  std::vector<Node> nodes_;
};

}  // namespace hemomag::lattice
