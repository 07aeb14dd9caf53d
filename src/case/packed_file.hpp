#pragma once
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/placement.hpp"

namespace hemomag::case_ {

/// Name of the packed state in the directories of `pack` and `run`.
inline constexpr const char* packed_copy = "packed.data";

/// A packed state to be kept: the LAMMPS data file of its cells (cells_data.hpp) under a first line
/// that says in which units.
std::string packed_data(const Case& c, const System& system);

/// The cells of placement = { file = ... }, whole and in metres.
/// @throws Error with the place in the case file, and the line of the data file, when it cannot be
/// read or does not fit the case: its box, its walls, the number of cells of each entry, or their
/// meshes
std::vector<System::PlacedCell> read_packed(const Case& c, const std::vector<CellModel>& models);

}  // namespace hemomag::case_
