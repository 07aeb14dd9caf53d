// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/wall,FixHemoWall)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_WALL_H
#define LMP_FIX_HEMO_WALL_H

#include "fix.h"

#include "contact/wall.hpp"

namespace LAMMPS_NS {

class FixHemoFluid;

/// `fix hemo/wall`: the wall of the fluid's vessel repels atoms (docs/styles/fix_hemo_wall.md).
class FixHemoWall : public Fix {
public:
  FixHemoWall(LAMMPS*, int, char**);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;
  double compute_scalar() override;

private:
  void beyond_wall(int i) const;

  hemomag::contact::WallRepulsion wall_;
  FixHemoFluid* fluid_ = nullptr;
  double energy_ = 0;  // of this rank's atoms
};

}  // namespace LAMMPS_NS

#endif
#endif
