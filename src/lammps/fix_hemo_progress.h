// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/progress,FixHemoProgress)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_PROGRESS_H
#define LMP_FIX_HEMO_PROGRESS_H

#include "fix.h"

namespace LAMMPS_NS {

class FixHemoSeries;

/// `fix hemo/progress dt_s DT`: a live line on the terminal of rank 0
/// (docs/styles/fix_hemo_progress.md).
class FixHemoProgress : public Fix {
public:
  FixHemoProgress(LAMMPS*, int, char**);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  void post_run() override;

private:
  void print(double now);

  double dt_s_ = 1;
  bool terminal_ = false;
  double started_ = 0, printed_ = 0;
  bigint first_ = 0;
  FixHemoSeries* series_ = nullptr;
};

}  // namespace LAMMPS_NS

#endif
#endif
