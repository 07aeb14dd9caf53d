#pragma once
#include <span>
#include <vector>

#include "analysis/inside.hpp"

namespace hemomag::analysis {

/// Thickness of the cell-free layer at one plate at one time.
struct CellFreeLayer {
  /// Distance from the plate to the first cell surface above it, averaged over the plate: what a
  /// carrier near the wall has to itself. A column in which there is none up to half the channel's
  /// height counts with that half.
  double mean = 0;
  /// The same to the first cell surface seen along the vorticity: the nearest over x at each
  /// position along the flow, averaged along it, as the edge of the cell core in a microscope's
  /// picture. It becomes thinner the deeper the channel is along x.
  double seen = 0;
};

/// The cell surfaces that face the two plates, in columns over the x-y plane: for each column's
/// middle the distance from either plate to the first cell surface.
class FacingSurfaces {
public:
  /// @param spacing  of the columns at most; there is a whole number of them along x and y
  FacingSurfaces(const Vec3& channel, double spacing);

  void clear();
  /// Take the triangles into account, wherever their periodic image along x and y.
  void add(std::span<const SurfaceTriangle> triangles);

  /// Distances [2 plates][columns along y][columns along x], lower plate first, for a minimum over
  /// ranks.
  std::span<double> distances() { return distance_; }
  /// Of one plate (0: lower, 1: upper).
  CellFreeLayer layer(int plate) const;

private:
  void add_triangle(const SurfaceTriangle& t);
  Vec3 channel_;
  int n_[2];
  double step_[2];
  std::vector<double> distance_;
};

}  // namespace hemomag::analysis
