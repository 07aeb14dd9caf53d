#pragma once
#include <string>

#include "lattice/surface.hpp"

namespace hemomag::io {

/// Read a closed surface; the ending of the name says the format, in capitals or not.
///   .stl  binary or ASCII; corners that coincide are joined (`lattice::weld`)
///   .off  with or without colours and normals, which are passed over
///   .ply  ASCII or binary of either byte order; elements other than vertex and face are passed
///   over
/// Polygons are cut into a fan of triangles about their first corner, which suits convex ones.
/// Normals in the file are not used: `lattice::closed` checks the triangles and turns them outward.
/// Coordinates keep the file's unit. Memory is taken for what the file holds, not for what it says.
/// @throws Error of one line with the path, the place (line number of a text) and what is accepted
lattice::Surface read_surface(const std::string& path);

}  // namespace hemomag::io
