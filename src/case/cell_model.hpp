#pragma once
#include <functional>
#include <string>
#include <vector>

#include "base/vec3.hpp"
#include "case/case.hpp"
#include "membrane/mesh.hpp"
#include "membrane/stress_free.hpp"
#include "membrane/topology.hpp"

namespace hemomag::case_ {

/// What all cells of one [[cell]] entry have in common, in metres: the mesh of the rest shape about
/// its centre, z its axis if it has one.
struct CellModel {
  membrane::TriangleMesh mesh;
  membrane::Topology topology;
  std::vector<double> rest_length;  ///< [n_e]  at which the springs are at rest
  membrane::Prestress prestress;    ///< of the mesh against these
  double area = 0, volume = 0;      ///< of the mesh
  double longest_edge = 0;          ///< of the mesh
  double longest_rest_length = 0;
  double radius = 0;        ///< half the diameter; of a user's surface that of a sphere of its area
  double reach = 0;         ///< of the farthest point from the centre
  double vertex_share = 0;  ///< area a vertex, over that of a red cell of 3286 vertices
  std::function<bool(const Vec3&)> contains;  ///< whether a point lies inside the rest shape
};

/// What a kind of cell is when the case file says nothing else; docs/case_file.md gives the
/// reasons.
Cell standard_cell(CellKind kind);

/// Thinnest platelet for which the generator reaches its gates at every number of vertices.
inline constexpr double least_thickness = 0.2;  ///< over the diameter

/// The shape on which a red cell's network is at rest with stress_free = "sphere": an oblate
/// spheroid of the reduced volume 0.997.
inline constexpr double near_sphere_aspect = 0.9;  ///< thickness over diameter

/// Read a user's own surface, in the file's unit and about its centre of volume.
/// @throws Error when it cannot be read, is not closed, falls into pieces or has too many vertices
std::shared_ptr<const lattice::Surface> read_cell_surface(const std::string& path);

/// Name of the copy of a user's surface in the run directory; empty without one.
std::string mesh_copy(const Case& c, std::size_t entry);

/// The models of the [[cell]] entries.
/// @throws Error with the place in the case file when a mesh cannot be made
std::vector<CellModel> cell_models(const Case& c);

}  // namespace hemomag::case_
