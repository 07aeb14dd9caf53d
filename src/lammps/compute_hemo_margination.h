// clang-format off
#ifdef COMPUTE_CLASS
ComputeStyle(hemo/margination,ComputeHemoMargination)
#else
// clang-format on

#ifndef LMP_COMPUTE_HEMO_MARGINATION_H
#define LMP_COMPUTE_HEMO_MARGINATION_H

#include <vector>

#include "compute.h"

#include "analysis/margination.hpp"

namespace LAMMPS_NS {

class FixHemoFluid;

/// `compute hemo/margination`: carriers in the cell-free layer, Eq. 46
/// (docs/styles/compute_hemo_margination.md).
class ComputeHemoMargination : public Compute {
public:
  ComputeHemoMargination(LAMMPS*, int, char**);
  ~ComputeHemoMargination() override;
  void init() override;
  void compute_vector() override;

  /// Carriers that lay in the layer at the first call, and to go on from them after a restart.
  long at_start() const { return at_start_; }
  void resume(long at_start) { at_start_ = at_start; }

private:
  /// Where a carrier's atom is: its height, or its distance from the vessel's wall.
  double height(int i) const;
  std::vector<double> heights() const;

  double layer_ = 0;
  hemomag::analysis::LayerWalls walls_ = hemomag::analysis::LayerWalls::lower;
  bool in_vessel_ = false;  // heights are distances from the wall, of which there is one
  FixHemoFluid* fluid_ = nullptr;
  long at_start_ = -1;
};

}  // namespace LAMMPS_NS

#endif
#endif
