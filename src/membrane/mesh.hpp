#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/vec3.hpp"
#include "membrane/rest_shape.hpp"

namespace hemomag::membrane {

/// A triangulated surface. Triangles are listed counter-clockwise seen from outside (right-hand
/// rule: normals out).
struct TriangleMesh {
  std::vector<Vec3> x;                        ///< [n_v]  vertex positions
  std::vector<std::array<int, 3>> triangles;  ///< [n_t]  vertex indices
};

/// What the mechanics of a network depends on. A network that is to act as an isotropic sheet must
/// be irregular and near-equilateral everywhere (a projected icosphere is neither).
struct MeshQuality {
  double mean_edge_ratio = 0;   ///< longest over shortest edge of a triangle, mean over triangles
  double worst_edge_ratio = 0;  ///< the same, largest
  double smallest_angle = 0;    ///< of all triangles [degrees]
  int min_valence = 0;          ///< edges that meet at a vertex, fewest
  int max_valence = 0;          ///< the same, most
  double min_edge = 0;          ///< length of the shortest edge
  double mean_edge = 0;         ///< mean length over edges
  double max_edge = 0;          ///< length of the longest edge
  /// Order of the edges' directions phi seen along z, |<exp(i n phi)>| with n = 2, 6: whether the
  /// network has a stiff direction, and whether it is one lattice all over. Each edge counts by the
  /// square of its length seen over its length.
  double twofold = 0, sixfold = 0;
};

/// @throws hemomag::Error when the surface is not closed (see topology.hpp)
MeshQuality quality(const TriangleMesh& mesh);

double surface_area(const TriangleMesh& mesh);

/// Positive when the triangles are oriented outward.
double enclosed_volume(const TriangleMesh& mesh);

/// What evened_mesh promises for any count and seed.
struct MeshGates {
  static constexpr double mean_edge_ratio = 1.15;  ///< at most
  static constexpr double worst_edge_ratio = 1.6;  ///< at most
  static constexpr double smallest_angle = 30;     ///< at least [degrees]
  static constexpr int min_valence = 5, max_valence = 7;
};

/// What evened_mesh tries for in 20 draws, at 642 vertices and above; below, a random mesh has more
/// order and sqrt(642/vertices) times as much is allowed.
struct MeshOrder {
  static constexpr double twofold = 0.008, sixfold = 0.07;  ///< at most
};

inline constexpr int min_mesh_vertices = 162;

/// A cell at rest (rest_shape.hpp): axis of symmetry along z, centred at the origin, `vertices`
/// of them exactly, irregular, within MeshGates and of 20 draws the first within MeshOrder, or the
/// one nearest to it. The facets follow the smooth surface in the
/// mean, so that the enclosed volume is rest_volume(shape): vertices stand off it along the
/// normal by about mean curvature x edge^2 / 8 (on a red cell 17 nm at the rim at 642 vertices, 3
/// nm at 3286). The area is then 0.4 % above rest_area at 642 vertices, 0.1 % at 3286. The same
/// arguments give the same mesh.
/// @param vertices  at least min_mesh_vertices
/// @throws hemomag::Error when an argument is out of range or the gates are not reached, as on
/// spheroids thinner than a fifth of their diameter with few vertices
/// Cost: about 0.15 ms a vertex and draw; four draws in the mean at 642 vertices.
TriangleMesh evened_mesh(const RestShape& shape, int vertices, std::uint64_t seed);

/// evened_mesh of the biconcave cell of diameter D0.
inline TriangleMesh red_cell_mesh(int vertices, double diameter, std::uint64_t seed) {
  return evened_mesh(red_cell_shape(diameter), vertices, seed);
}

}  // namespace hemomag::membrane
