#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.hpp"
#include "case/case.hpp"
#include "case/cell_model.hpp"

namespace hemomag::case_ {

/// What a packed state is like (case/packing.hpp).
struct PackingReport {
  std::string method;  ///< compress, grow, or the file it was read from
  std::size_t cells = 0;
  double hematocrit = 0;    ///< the cells' rest volume over the fluid's
  long crossings = 0;       ///< pairs of triangles that cross; none in a state that is accepted
  double smallest_gap = 0;  ///< between the surfaces of two cells [m]; infinite above 1 um
  double wall_gap = 0;      ///< of a vertex from a wall [m]; infinite without walls
  double area_change = 0;   ///< largest |A/A0 - 1| of a cell
  double volume_change = 0;
  double largest_force = 0;  ///< left on a vertex when relaxation ended [N]
  long steps = 0;            ///< of packing and relaxation
  double seconds = 0;        ///< it took
};

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
  std::optional<PackingReport> packing;  ///< of cells that were packed or read from a file
};

/// Number of cells of an entry: its count, or the nearest to its hematocrit.
int cell_count(const Case& c, const Cell& cell, const CellModel& model);

/// Cells of every entry at random places and angles in the channel, whatever `placement` says, so
/// far apart as `place` promises.
/// @param counts  of each entry
/// @throws Error saying how many found a place when the channel is too full
std::vector<System::PlacedCell> scatter_cells(const Case& c, const std::vector<CellModel>& models,
                                              const std::vector<int>& counts);

/// Put cells, then carriers, into the channel: no cell nearer than 0.40 um to another (vertex to
/// vertex) or 0.3 um to a plate or a vessel's wall; carriers uniform in the fluid from 0.25 um off
/// the walls, at least 0.56 um from every vertex and outside every cell. The same case gives the
/// same state.
/// @throws Error saying how many found a place when the channel is too full
System place(const Case& c);

}  // namespace hemomag::case_
