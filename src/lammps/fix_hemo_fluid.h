// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/fluid,FixHemoFluid)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_FLUID_H
#define LMP_FIX_HEMO_FLUID_H

#include <memory>
#include <string>
#include <vector>

#include "fix.h"

namespace hemomag::solver {
class FlowController;
class FluidSolver;
struct FluidParameters;
}  // namespace hemomag::solver

namespace LAMMPS_NS {

/// `fix hemo/fluid`: the lattice Boltzmann fluid (docs/styles/fix_hemo_fluid.md). Last of the
/// post_force fixes.
class FixHemoFluid : public Fix {
public:
  FixHemoFluid(LAMMPS*, int, char**);
  ~FixHemoFluid() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;
  double compute_scalar() override;
  double compute_vector(int) override;
  double memory_usage() override;
  void write_restart(FILE*) override;
  void restart(char*) override;

  /// Take the populations of a restart from a file of FluidSolver::save, before the run.
  /// Collective.
  void load(const std::string& path);

  hemomag::solver::FluidSolver& solver();
  double viscosity() const;
  /// Hydrodynamic radius of a point coupled by this fluid's kernel, in nodes.
  double point_radius() const;
  /// Velocity of the fluid at the owned atoms of a group, into v[i]. Fatal when one has left the
  /// halo.
  void velocity_at_atoms(int groupbit, double** v);

private:
  enum class Initial { rest, linear };

  void create_solver();
  int parse_keyword(int narg, char** arg, int at);
  void check_scheme();
  void hold_mean_velocity();
  void require_place_in_script() const;
  void lost_point(long index, const char* doing) const;

  std::unique_ptr<hemomag::solver::FluidParameters> parameters_;
  std::unique_ptr<hemomag::solver::FluidSolver> solver_;
  Initial initial_ = Initial::rest;
  std::string scheme_ = "trt";
  int driven_axis_ = -1;  // whose mean velocity is held
  double mean_velocity_ = 0;
  std::unique_ptr<hemomag::solver::FlowController> controller_;
  int one_way_bits_ = 0;  // groups whose forces the fluid does not feel
  bigint done_step_ = -1;
  double restored_force_[3] = {0, 0, 0};
  std::vector<double> restored_book_;  // steps booked, momenta of both plates
  bool lacks_populations_ = false;     // the restart file has been read, the fluid's own not yet
};

}  // namespace LAMMPS_NS

#endif
#endif
