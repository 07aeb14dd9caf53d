// clang-format off
#ifdef ANGLE_CLASS
AngleStyle(hemo/membrane,AngleHemoMembrane)
#else
// clang-format on

#ifndef LMP_ANGLE_HEMO_MEMBRANE_H
#define LMP_ANGLE_HEMO_MEMBRANE_H

#include <array>
#include <span>
#include <vector>

#include "angle.h"

#include "analysis/inside.hpp"
#include "base/vec3.hpp"
#include "lammps/coefficients.hpp"
#include "lammps/topology_watch.hpp"
#include "membrane/network.hpp"
#include "solver/cell_sums.hpp"

namespace LAMMPS_NS {

/// `angle_style hemo/membrane`: local and global area and volume of cells, one angle a triangle
/// (docs/styles/angle_hemo_membrane.md).
class AngleHemoMembrane : public Angle {
public:
  /// A whole cell, as every rank that holds a part of it knows it after a force computation.
  struct CellState {
    tagint molecule;
    double area, volume;    ///< present, summed over ranks
    double area0, volume0;  ///< rest values
    bool mine;              ///< true on exactly one rank
  };

  explicit AngleHemoMembrane(LAMMPS*);
  ~AngleHemoMembrane() override;
  void init_style() override;
  void compute(int, int) override;
  void coeff(int, char**) override;
  double equilibrium_angle(int) override { return 0; }
  void write_restart(FILE*) override;
  void read_restart(FILE*) override;
  void write_data(FILE*) override;
  double single(int, int, int, int) override { return 0; }
  double memory_usage() override;

  std::span<const CellState> cells() const { return cells_; }

  /// This rank's triangles at the present positions, each cell in one piece, and the molecule each
  /// belongs to.
  struct Surface {
    std::vector<hemomag::analysis::SurfaceTriangle> triangles;
    std::vector<tagint> molecule;
  };
  Surface surface() const;

  /// Local indices of the corners of this rank's triangles, valid until the next neighbour list.
  std::vector<std::array<int, 3>> triangle_atoms() const;

private:
  enum Column { Cq, q, k_a, A_t0, k_v, V_0, k_d, A_k0, columns };
  struct Triangle {
    int i, j, k, type;
    std::size_t cell;      // slot in cells_
    hemomag::Vec3 unwrap;  // from x[j] to the cell's own image
  };

  void allocate();
  void check(int type) const;
  void rebuild();
  void agree_on_images();
  void fill_list();
  void check_constants() const;
  void sum_cells();
  hemomag::membrane::TriangleList::Pull pull(std::size_t cell) const;
  void tally();
  void tally_volume();

  hemomag::lammps::Coefficients<columns> coefficients_;
  std::vector<Triangle> triangles_;       // cell by cell
  hemomag::membrane::TriangleList list_;  // the same, as the force loops read them
  std::vector<CellState> cells_;
  std::vector<int> cell_type_;  // a triangle type of each cell, for its global constants
  std::vector<double> sums_;    // area and volume of each cell
  hemomag::solver::CellSums exchange_;
  bool oriented_ = false;
  hemomag::lammps::TopologyWatch topology_;
};

}  // namespace LAMMPS_NS

#endif
#endif
