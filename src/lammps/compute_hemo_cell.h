// clang-format off
#ifdef COMPUTE_CLASS
ComputeStyle(hemo/cell,ComputeHemoCell)
#else
// clang-format on

#ifndef LMP_COMPUTE_HEMO_CELL_H
#define LMP_COMPUTE_HEMO_CELL_H

#include <array>
#include <optional>
#include <vector>

#include "compute.h"

#include "analysis/cell_shape.hpp"
#include "base/vec3.hpp"
#include "lammps/angle_hemo_membrane.h"

namespace LAMMPS_NS {

/// `compute hemo/cell`: size, place, shape and phase of every cell, a row each
/// (docs/styles/compute_hemo_cell.md).
class ComputeHemoCell : public Compute {
public:
  /// Columns of the array, from 0.
  enum Column {
    molecule,
    volume,
    area,
    centre,
    velocity = centre + 3,
    semi_axes = velocity + 3,
    long_axis = semi_axes + 3,
    short_axis = long_axis + 3,
    taylor = short_axis + 3,
    taylor_in_plane,
    inclination,
    phase,
    treading,
    extent,
    columns = extent + 3
  };

  ComputeHemoCell(LAMMPS*, int, char**);
  ~ComputeHemoCell() override;
  void init() override;
  void compute_array() override;

  /// What is carried from one call to the next, and to go on with it after a restart.
  std::vector<double> followed() const;
  /// @throws Error when it is of other cells
  void resume(const std::vector<double>& followed);

private:
  using Surface = AngleHemoMembrane::Surface;
  /// What is carried from one call to the next.
  struct Followed {
    tagint marker = 0;
    double phase = 0, axis = 0;  // [rad], counted over turns
    hemomag::Vec3 centre;        // unwrapped
  };
  /// A cell about its reference point, which all ranks agree on.
  struct Cell {
    hemomag::Vec3 reference;  // mean of the triangles' centroids, in the image of the surface
    hemomag::Vec3 velocity;   // mean over vertices
    hemomag::analysis::CellShape shape;
    hemomag::Vec3 lo, hi, marker;  // about the reference point
    std::array<int, 3> image;      // image flags of the surface's image
  };

  std::optional<std::size_t> row_of(tagint id) const;
  std::vector<std::size_t> rows_of(const Surface& surface) const;
  void find_references(const Surface& surface, const std::vector<std::size_t>& row);
  void find_shapes(const Surface& surface, const std::vector<std::size_t>& row);
  void choose_markers(const Surface& surface, const std::vector<std::size_t>& row);
  void find_extremes(const Surface& surface, const std::vector<std::size_t>& row);
  void follow(std::size_t r);
  void write_row(std::size_t r);

  std::vector<tagint> ids_;  // cells, ascending
  std::vector<Cell> cells_;
  std::vector<Followed> followed_;
  bool started_ = false;
  AngleHemoMembrane* membrane_ = nullptr;
};

}  // namespace LAMMPS_NS

#endif
#endif
