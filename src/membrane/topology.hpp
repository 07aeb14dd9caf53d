#pragma once
#include <array>
#include <vector>

#include "membrane/mesh.hpp"

namespace hemomag::membrane {

/// Two vertices joined by a spring, a < b.
struct Edge {
  int a, b;
  friend bool operator==(const Edge&, const Edge&) = default;
};

/// The two triangles (i1,i2,i3) and (i4,i3,i2) on the edge i2-i3, both counter-clockwise seen from
/// outside:
///        i3
///      / | \          .
///    i1  |  i4
///      \ | /
///        i2
/// This is the order of the dihedrals in the authors' cell file and of dihedral_style hemo/bend.
using Hinge = std::array<int, 4>;

struct Topology {
  std::vector<Edge> edges;  ///< [n_e]  sorted by (a, b), each once
  std::vector<Hinge>
      hinges;  ///< [n_e]  hinge e turns about edge e: hinges[e][1] = a, hinges[e][2] = b
};

/// Edges and hinges of a closed, consistently oriented surface.
/// @throws hemomag::Error naming the edge (or triangle) where the surface is open, branches or
/// changes orientation
Topology topology(const TriangleMesh& mesh);

}  // namespace hemomag::membrane
