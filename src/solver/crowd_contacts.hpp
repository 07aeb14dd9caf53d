#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/vec3.hpp"
#include "contact/surface_repulsion.hpp"
#include "lattice/near_points.hpp"

namespace hemomag::solver {

/// The surfaces of a crowd as its contacts see them: one array of vertices, cell after cell.
struct CrowdSurfaces {
  std::vector<int> cell;                      ///< [n_v]  of each vertex
  std::vector<std::array<int, 3>> triangles;  ///< [n_t]  vertices
  std::vector<double> share;                  ///< [n_v]  surface that a vertex stands for
  std::vector<double> gap;  ///< [n_v]  two vertices of different cells keep the larger of theirs
};

/// How far cells keep from each other.
struct CrowdContact {
  double stiffness = 500;  ///< of every repulsion, per area of surface [pressure/length]
  double range = 0.2;      ///< of a vertex from the triangles of another cell
  /// Contacts reckon with lists until a vertex has moved half of this.
  double skin = 0.15;
};

/// Repulsion between the cells of a crowd: of every vertex from the nearest triangle of each other
/// cell or periodic image, and of vertices from vertices. A cell does not feel itself.
class CrowdContacts {
public:
  CrowdContacts(const CrowdContact& contact, const lattice::PeriodicBox& box)
      : contact_(contact), box_(box) {}

  void build(const CrowdSurfaces& surfaces, std::span<const Vec3> x);

  /// Add the forces; `scale` multiplies all distances that are kept.
  /// @return the energy
  double add_forces(const CrowdSurfaces& surfaces, std::span<const Vec3> x, double scale,
                    std::span<Vec3> f) const;

  const CrowdContact& contact() const { return contact_; }
  lattice::PeriodicBox& box() { return box_; }

private:
  /// A vertex and the triangles of one other surface that are near it.
  struct Meeting {
    int vertex;
    std::size_t begin, end;  // in near_triangles_
    Vec3 shift;              // added to the other surface
  };
  struct Pair {
    int a, b;
    Vec3 shift;  // added to b
  };
  void list_triangles(const CrowdSurfaces& surfaces, std::span<const Vec3> x);
  void list_vertices(const CrowdSurfaces& surfaces, std::span<const Vec3> x);

  CrowdContact contact_;
  lattice::PeriodicBox box_;
  std::vector<Meeting> meetings_;
  std::vector<int> near_triangles_;
  std::vector<Pair> pairs_;
};

}  // namespace hemomag::solver
