#pragma once
#include <array>
#include <vector>

#include "base/vec3.hpp"
#include "case/case.hpp"
#include "case/cell_model.hpp"

namespace hemomag::case_ {

/// The starting state, in metres: whole cells and chains, not wrapped into the box.
struct System {
  std::vector<CellModel> models;  ///< one a [[cell]] entry
  struct PlacedCell {
    std::size_t model;
    std::vector<Vec3> x;
  };
  struct PlacedCarrier {
    std::size_t entry;        ///< of [[carrier]]
    std::vector<Vec3> beads;  ///< one for a particle
  };
  std::vector<PlacedCell> cells;
  std::vector<PlacedCarrier> carriers;
};

/// Number of cells of an entry: its count, or the nearest to its hematocrit.
int cell_count(const Case& c, const Cell& cell, const CellModel& model);

/// Put cells, then carriers, into the channel: no cell nearer than 0.40 um to another (vertex to
/// vertex) or 0.3 um to a plate or a vessel's wall; carriers uniform in the fluid from 0.25 um off
/// the walls, at least 0.56 um from every vertex and outside every cell. The same case gives the
/// same state.
/// @throws Error saying how many found a place when the channel is too full
System place(const Case& c);

}  // namespace hemomag::case_
