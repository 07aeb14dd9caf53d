// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/checkpoint,FixHemoCheckpoint)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_CHECKPOINT_H
#define LMP_FIX_HEMO_CHECKPOINT_H

#include <string>
#include <vector>

#include "fix.h"

#include "lammps/signals.hpp"

namespace LAMMPS_NS {

class FixHemoFluid;
class FixHemoWatch;

/// `fix hemo/checkpoint`: saves the whole state now and then, at the end and when a signal asks for
/// it (docs/styles/fix_hemo_checkpoint.md).
///
/// Nothing of the run changes by a checkpoint. It is taken at the end of a step in which LAMMPS has
/// just made its neighbour lists (atoms lie in their own rank's block, in an order that the restart
/// file keeps) and the fluid's populations lie at their own nodes; a resumed run makes the same
/// lists from the same positions, and computes the same forces, bit by bit. Such steps come by
/// themselves when atoms move; every `every` steps they are made to come, in every run alike.
class FixHemoCheckpoint : public Fix {
public:
  FixHemoCheckpoint(LAMMPS*, int, char**);
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_pre_neighbor() override;
  void setup(int) override;
  void end_of_step() override;
  double compute_scalar() override { return static_cast<double>(last_step_); }
  double compute_vector(int) override;

  /// Seconds spent on checkpoints by this process.
  double seconds() const { return spent_; }

private:
  enum Bits { due = 8, waited = 16, slow = 32 };  // beside those of SignalsNoted

  void parse(int narg, char** arg);
  void schedule();
  int consult();
  bool seamless() const;
  void save();
  void served(double seconds);
  template <class Work> void attempt(Work work);
  void stop(int signal);

  std::string directory_, resumed_;
  std::vector<std::string> kept_;
  double interval_ = 600;  // [s]; 0: at every occasion
  double wall_before_ = 0;
  int every_ = 100;
  int pending_ = 0;                 // bits of what a checkpoint is wanted for
  double wanted_since_ = 0;         // on rank 0
  bool each_step_ = true;           // all ranks are asked in each step: steps are slow
  double consulted_ = 0;            // MPI_Wtime
  double started_ = 0, saved_ = 0;  // MPI_Wtime
  double spent_ = 0;                // [s] on checkpoints
  bigint last_step_ = -1;           // of a checkpoint
  long count_ = 0;
  int sort_every_ = 0;
  bool restores_order_ = false, loaded_ = false;
  hemomag::lammps::SignalsNoted signals_;
  FixHemoFluid* fluid_ = nullptr;
  FixHemoWatch* watch_ = nullptr;
};

}  // namespace LAMMPS_NS

#endif
#endif
