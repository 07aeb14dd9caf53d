// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/drag,FixHemoDrag)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_DRAG_H
#define LMP_FIX_HEMO_DRAG_H

#include <vector>

#include "fix.h"

namespace LAMMPS_NS {

class FixHemoFluid;
class PairHemoDipole;

/// `fix hemo/drag`: carriers, overdamped or with inertia, with the stiff forces between them
/// sub-stepped (docs/styles/fix_hemo_drag.md).
class FixHemoDrag : public Fix {
public:
  FixHemoDrag(LAMMPS*, int, char**);
  ~FixHemoDrag() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void post_force(int) override;
  double compute_scalar() override { return substeps_; }
  double memory_usage() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  void write_restart(FILE*) override;
  void restart(char*) override;
  int pack_restart(int, double*) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override { return restart_width; }
  int maxsize_restart() override { return restart_width; }
  int pack_exchange(int, double*) override;
  int unpack_exchange(int, double*) override;
  int pack_forward_comm(int, int*, double*, int, int*) override;
  void unpack_forward_comm(int, int, double*) override;
  int pack_reverse_comm(int, int, double*) override;
  void unpack_reverse_comm(int, int*, double*) override;

  static constexpr int most_substeps = 16;

  bool feedback() const { return feedback_; }
  int substeps() const { return substeps_; }

  /// Dipole and contact forces of owned carriers at the present positions, as every sub-step needs
  /// them. Collective; needs a dipole style and a neighbour list.
  void stiff_forces();
  /// Pairs within the dipoles' cut-off, over all ranks. Collective.
  long pairs();
  /// Positions of ghost carriers, as between two sub-steps. Collective.
  void forward_positions();

private:
  static constexpr int restart_width = 4;  // its own length, then the force

  /// What a carrier type is. Friction and relaxation time follow in init.
  struct Kind {
    double radius = 0;           // 0: not a carrier
    double mass = 0;             // 0: overdamped
    double mobility = 0;         // 1/Gamma_bare
    double relaxation_time = 0;  // mass/Gamma_bare
  };
  double bare_friction(double radius) const;
  void choose_substeps();
  bool carrier(int i) const;
  const Kind& kind_of(int i) const;

  std::vector<Kind> kinds_;  // by type
  bool feedback_ = true;
  int substeps_ = 1;
  int most_reported_ = 0;  // sub-steps that the log knows of
  bigint chosen_at_ = -1;  // step of the neighbour list for which substeps_ was chosen
  bool started_ = false;   // added_ holds the force of the last step
  FixHemoFluid* fluid_ = nullptr;
  PairHemoDipole* dipoles_ = nullptr;
  double** added_ = nullptr;  // what post_force added for the last step, as contained in f
  double** stiff_ = nullptr;  // of the present sub-step, owned and ghost
  double** drift_ = nullptr;  // u_f + F'/Gamma of the present step
};

}  // namespace LAMMPS_NS

#endif
#endif
