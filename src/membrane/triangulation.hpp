#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace hemomag::membrane {

/// A closed triangulation whose edges can be flipped: the triangles (a,b,c) and (d,c,b) become
/// (a,b,d) and (d,c,a).
///        c                 c
///      / | \             /   \            .
///     a  |  d    ->     a --- d
///      \ | /             \   /
///        b                 b
/// Orientation and the number of vertices and triangles never change.
class Triangulation {
public:
  /// @param triangles  closed and consistently oriented over `vertices` vertices
  Triangulation(int vertices, std::vector<std::array<int, 3>> triangles);

  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  const std::vector<int>& valences() const { return valences_; }

  /// Flip, once each and in order, the edges whose opposite angles add up to more than pi (Delaunay
  /// on the surface).
  /// @return the number of flips
  int flip_to_delaunay(std::span<const Vec3> x);

  /// Flip the edges that bring the valences closer to 6 (less sum of (valence - 6)^4), and those
  /// that leave the sum as it is and are Delaunay flips. The fourth power trades a vertex of 4 or 8
  /// for some of 5 and 7. Flips that would fold the surface are left out.
  /// @return the number of flips
  int flip_to_even_valences(std::span<const Vec3> x);

private:
  struct Quad {
    int a, b, c, d, left, right, j,
        k;  // the vertices above; the two triangles; the places of a and d in them
  };
  Quad quad(int triangle, int j) const;
  bool joined(int a, int d, int triangle) const;
  void flip(const Quad& q);

  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::array<int, 3>>
      across_;  // across_[t][j]: the triangle on the edge opposite triangles_[t][j]
  std::vector<int> valences_;
};

/// Delaunay triangulation of points on a sphere about the origin, outward: their convex hull.
/// @throws hemomag::Error when a point is not on the hull (points that coincide)
std::vector<std::array<int, 3>> triangulate_sphere(std::span<const Vec3> points);

}  // namespace hemomag::membrane
