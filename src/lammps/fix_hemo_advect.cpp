#include "lammps/fix_hemo_advect.h"

#include <string>

#include "atom.h"
#include "error.h"

#include "lammps/compat.hpp"
#include "lammps/fix_hemo_fluid.h"

using namespace LAMMPS_NS;

FixHemoAdvect::FixHemoAdvect(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  time_integrate = 1;
  if (narg != 3) error->all(FLERR, std::string("fix hemo/advect takes no arguments"));
}

int FixHemoAdvect::setmask() { return FixConst::INITIAL_INTEGRATE; }

void FixHemoAdvect::init() {
  fluid_ = hemomag::lammps::find_fix<FixHemoFluid>(lmp, "hemo/fluid");
  if (!fluid_) error->all(FLERR, std::string("fix hemo/advect needs a fix hemo/fluid"));
}

/// X(t + 1) = X(t) + u(X(t), t) (Eqs. 28, 32).
void FixHemoAdvect::initial_integrate(int) {
  fluid_->velocity_at_atoms(groupbit, atom->v);
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit)
      for (int d = 0; d < 3; ++d) atom->x[i][d] += atom->v[i][d];
}
