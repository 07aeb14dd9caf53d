#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hemomag::membrane {

/// Which triangles of one closed surface must be turned so that all have the same sense of
/// rotation. Neighbours agree when they run through their common edge in opposite directions; where
/// the surface falls into two senses, the smaller part of it is turned.
/// @param triangles  vertex ids, any numbers
std::vector<char> triangles_to_turn(std::span<const std::array<std::int64_t, 3>> triangles);

}  // namespace hemomag::membrane
