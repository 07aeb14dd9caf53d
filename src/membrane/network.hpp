#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/simd.hpp"
#include "base/vec3.hpp"
#include "membrane/bending.hpp"
#include "membrane/network_kernels.hpp"
#include "membrane/springs.hpp"

// The edges, triangles and hinges of membranes as the force loops read them: one contiguous array a
// quantity, padded for SIMD, filled when the topology changes and only read in a step. Vertices are
// indices into x_v and f_v. Forces are added to f_v in the order of the list, whatever the level.

namespace hemomag::membrane {

/// Springs (springs.hpp), in runs of one exponent.
class EdgeList {
public:
  void clear();
  /// Edges of one run come one after the other: a new exponent starts a new run.
  void add(int i, int j, const Spring& spring);
  /// Pad the last run; before the list is used.
  void finish();

  /// Add the tension of every edge to the forces on its ends.
  /// @return the first edge at or beyond its l_max, or -1; the forces are then meaningless
  std::ptrdiff_t add_forces(std::span<const Vec3> x_v, std::span<Vec3> f_v,
                            SimdLevel level = simd_level()) const;

  int vertex(int end, std::ptrdiff_t e) const {
    return vertex_[static_cast<std::size_t>(end)][static_cast<std::size_t>(e)];
  }
  double l_max(std::ptrdiff_t e) const { return l_max_[static_cast<std::size_t>(e)]; }

private:
  struct Run {
    std::size_t begin, count;
    double m;
  };
  std::array<std::vector<int>, 2> vertex_;
  std::vector<double> l_max_, wlc_, k_p_;
  std::vector<Run> runs_;
};

/// Triangles (area_volume.hpp), cell by cell.
class TriangleList {
public:
  void clear();
  /// The triangles added from here on are the next cell's.
  void start_cell();
  /// @param unwrap  what brings vertex 1 into the one image that all of the cell is measured in
  /// @param k_d, area0  local area constant and rest area
  void add(const std::array<int, 3>& vertices, const Vec3& unwrap, double k_d, double area0);
  void finish();

  std::size_t cells() const { return cells_.size(); }
  /// Area and volume of the triangles listed for a cell: its whole, or this rank's part of it.
  CellGeometry geometry(std::size_t cell, std::span<const Vec3> x_v,
                        SimdLevel level = simd_level()) const;

  /// dE/dA and dE/dV of the cell as a whole.
  struct Pull {
    double area, volume;
  };
  void add_forces(std::size_t cell, const Pull& pull, std::span<const Vec3> x_v,
                  std::span<Vec3> f_v, SimdLevel level = simd_level()) const;

  double bytes() const;

private:
  struct Cell {
    std::size_t begin, count;
  };
  TriangleArgs arguments(std::size_t cell, std::span<const Vec3> x_v) const;

  std::array<std::vector<int>, 3> vertex_;
  std::array<std::vector<double>, 3> unwrap_;
  std::vector<double> k_d_, area0_;
  std::vector<Cell> cells_;
};

/// Hinges (bending.hpp).
class HingeList {
public:
  void clear();
  void add(const std::array<int, 4>& vertices, const Bending& bending);
  void finish();
  void add_forces(std::span<const Vec3> x_v, std::span<Vec3> f_v,
                  SimdLevel level = simd_level()) const;

private:
  std::array<std::vector<int>, 4> vertex_;
  std::vector<double> k_b_, sine0_, cosine0_;
  std::size_t count_ = 0;
};

}  // namespace hemomag::membrane
