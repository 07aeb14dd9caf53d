// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/advect,FixHemoAdvect)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_ADVECT_H
#define LMP_FIX_HEMO_ADVECT_H

#include "fix.h"

namespace LAMMPS_NS {

class FixHemoFluid;

/// `fix hemo/advect`: membrane vertices move with the fluid (docs/styles/fix_hemo_advect.md).
class FixHemoAdvect : public Fix {
public:
  FixHemoAdvect(LAMMPS*, int, char**);
  int setmask() override;
  void init() override;
  void initial_integrate(int) override;

private:
  FixHemoFluid* fluid_ = nullptr;
};

}  // namespace LAMMPS_NS

#endif
#endif
