#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec3.hpp"

// Snapshots read back, by one process (vtkhdf.hpp writes them).

namespace hemomag::io {

/// A lattice of points with a vector on each, x fastest.
struct VectorImage {
  std::array<int, 3> nodes{};
  double spacing = 0;
  std::vector<Vec3> values;
};
/// @throws Error with path and reason
VectorImage read_image(const std::string& path, const std::string& array);

/// Triangles of an UnstructuredGrid, of all its partitions.
struct TriangleGrid {
  std::vector<Vec3> points;
  std::vector<std::array<std::int64_t, 3>> triangles;
};
/// @throws Error with path and reason
TriangleGrid read_triangles(const std::string& path);

/// Files and times [s] of a `.series` index, in its order. @throws Error with path and reason
struct SnapshotTime {
  std::string file;  ///< beside the index
  double time_s;
};
std::vector<SnapshotTime> read_series(const std::string& path);

}  // namespace hemomag::io
