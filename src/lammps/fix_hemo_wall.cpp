#include "lammps/fix_hemo_wall.h"

#include <string>

#include "atom.h"
#include "error.h"
#include "utils.h"

#include "lammps/accident.hpp"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_fluid.h"
#include "solver/fluid_solver.hpp"

using namespace LAMMPS_NS;
using hemomag::Vec3;

FixHemoWall::FixHemoWall(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  scalar_flag = 1;
  global_freq = 1;
  extscalar = 0;  // a total: not to be divided by the number of atoms
  if (narg != 6) error->all(FLERR, std::string("fix hemo/wall needs EPSILON SIGMA CUTOFF"));
  wall_.epsilon = utils::numeric(FLERR, arg[3], false, lmp);
  wall_.sigma = utils::numeric(FLERR, arg[4], false, lmp);
  wall_.cutoff = utils::numeric(FLERR, arg[5], false, lmp);
  if (!(wall_.epsilon >= 0 && wall_.sigma > 0 && wall_.cutoff > 0))
    error->all(FLERR, std::string("fix hemo/wall: EPSILON must be at least 0, SIGMA and CUTOFF "
                                  "above 0"));
}

int FixHemoWall::setmask() { return FixConst::POST_FORCE; }

void FixHemoWall::init() {
  fluid_ = hemomag::lammps::find_fix<FixHemoFluid>(lmp, "hemo/fluid");
  if (!fluid_) error->all(FLERR, std::string("fix hemo/wall needs a fix hemo/fluid"));
}

void FixHemoWall::setup(int vflag) {
  // The fluid is made in its own init, which comes after this fix's.
  if (!fluid_->solver().has_vessel())
    error->all(FLERR, std::string("fix hemo/wall: the fluid has no vessel; define fix hemo/fluid "
                                  "with tube or surface, or use fix wall/lj126 at plates"));
  post_force(vflag);
}

/// F = -dE/dx of E(d(x)) with the fluid's distance d to the wall, owned atoms.
void FixHemoWall::post_force(int) {
  const auto& fluid = fluid_->solver();
  energy_ = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const auto [distance, gradient] =
        fluid.wall_distance({atom->x[i][0], atom->x[i][1], atom->x[i][2]});
    if (!(distance > 0)) {  // not a number is neither
      beyond_wall(i);
      continue;
    }
    const double push = hemomag::contact::force(wall_, distance);
    for (std::size_t d = 0; d < 3; ++d) atom->f[i][d] += push * gradient[d];
    energy_ += hemomag::contact::energy(wall_, distance);
  }
}

void FixHemoWall::beyond_wall(int i) const {
  const double* x = atom->x[i];
  hemomag::lammps::accident(
      lmp, "fix hemo/wall",
      "atom " + std::to_string(atom->tag[i]) + " at " + std::to_string(x[0]) + " " +
          std::to_string(x[1]) + " " + std::to_string(x[2]) +
          " is beyond the vessel's wall (forces too strong for the time step?)");
}

double FixHemoWall::compute_scalar() {
  double all = 0;
  MPI_Allreduce(&energy_, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}
