#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace hemomag::analysis {

/// A triangle of a cell, near any periodic image along x and y; along z in the cell's own image.
struct SurfaceTriangle {
  std::array<Vec3, 3> x;
  std::array<std::int64_t, 3> tag;  ///< vertex ids
};

/// The channel: periodic along x and y; along z only if `periodic_z`.
struct ChannelBox {
  Vec3 size;
  bool periodic_z = false;
};

/// How many times each point is enclosed by these triangles, as far as they tell: the sum over all
/// ranks' triangles of closed surfaces is 1 for a point inside a cell and 0 outside.
///
/// A ray from the point along +z counts each triangle it crosses with the sense of its normal. With
/// a periodic z a triangle counts once for each image of the point below it, floor((z_triangle -
/// z)/L_z): counts of different images differ by the same number for every crossing of a closed
/// surface and cancel. A ray through an edge belongs to one of its triangles: the edge's side is
/// decided in the order of its tags, the same way from both. Cost: linear in triangles and points
/// for evenly spread points (they are sorted into columns).
std::vector<int> enclosure(std::span<const Vec3> points, std::span<const SurfaceTriangle> triangles,
                           const ChannelBox& box);

}  // namespace hemomag::analysis
