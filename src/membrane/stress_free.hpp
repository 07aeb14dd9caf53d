#pragma once
#include <vector>

#include "membrane/mesh.hpp"
#include "membrane/rest_shape.hpp"
#include "membrane/topology.hpp"

namespace hemomag::membrane {

/// Lengths at which the edges of a cell are at rest when its network is free of stress on another
/// body of revolution, e.g. nearly a sphere.
///
/// The network goes to the other body as an incompressible sheet does that stays a body of
/// revolution while the cell is inflated: every point keeps its azimuth and the fraction of the
/// area above it. That body is scaled to the area of the mesh. Its edges may then be read off;
/// triangles keep their area but for their flatness. On the cell the network is sheared: by (r/r')
/// along parallels and (r'/r) along meridians, r and r' the distances from the axis.
/// @param mesh       evened_mesh(shape, ...)
/// @param reference  of any size
/// @return [n_e], in the unit of the mesh
std::vector<double> stress_free_lengths(const TriangleMesh& mesh, const std::vector<Edge>& edges,
                                        const RestShape& shape, const RestShape& reference);

/// How far a network is from its stress-free lengths.
struct Prestress {
  double mean = 0;     ///< |l/l0 - 1|, mean over edges
  double largest = 0;  ///< the same, largest
  double longest = 0;  ///< l/l0, largest
};
Prestress prestress(const TriangleMesh& mesh, const std::vector<Edge>& edges,
                    const std::vector<double>& rest_length);

}  // namespace hemomag::membrane
