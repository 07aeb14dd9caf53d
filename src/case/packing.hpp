#pragma once
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/placement.hpp"

namespace hemomag::case_ {

/// Densely packed cells and the state they were packed from.
struct PackedCells {
  std::vector<System::PlacedCell> first;  ///< loose, of full or of half size, perhaps coarser
  std::vector<System::PlacedCell> cells;
  PackingReport report;
};

/// That packing is known to reach; more is refused, but for the rounding to whole cells.
inline constexpr double largest_hematocrit = 0.6;

/// Vertices of the mesh with which cells of more are packed before they are carried to their own.
inline constexpr int packing_vertices = 642;

/// Put the cells of a case with placement "compress" or "grow" into its channel, as many as it asks
/// for, at rest and without a crossing. The same case gives the same state. How:
/// docs/decisions/packing.md.
/// @param models  of the [[cell]] entries
/// @throws Error with the place in the case file when they do not fit
PackedCells pack_cells(const Case& c, const std::vector<CellModel>& models);

/// Compare all surfaces of a state read from a file with each other, with themselves and with the
/// walls.
/// @throws Error with the place in the case file when two cross, one lies within another, or one
/// passes through a wall
PackingReport check_packed(const Case& c, const std::vector<CellModel>& models,
                           const std::vector<System::PlacedCell>& cells);

}  // namespace hemomag::case_
