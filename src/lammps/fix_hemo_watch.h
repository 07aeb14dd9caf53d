// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/watch,FixHemoWatch)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_WATCH_H
#define LMP_FIX_HEMO_WATCH_H

#include <string>

#include "fix.h"

namespace LAMMPS_NS {

class FixHemoFluid;
class AngleHemoMembrane;

/// `fix hemo/watch`: is the run still sound? (docs/styles/fix_hemo_watch.md)
class FixHemoWatch : public Fix {
public:
  struct WatchRecord {
    bigint cells_start = 0, cells_end = 0;
    bigint carriers_start = 0, carriers_end = 0;
    bigint carriers_inside_max = 0;  ///< carriers found inside cells at one time
    double mach_max = 0;
    double area_drift_max = 0, volume_drift_max = 0;  ///< largest |A/A0 - 1|, |V/V0 - 1| of a cell
  };

  FixHemoWatch(LAMMPS*, int, char**);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  void post_run() override;
  double compute_vector(int) override;

  const WatchRecord& record() const { return record_; }

private:
  void look();
  void check_finite();
  void check_mach();
  void check_counts(bool first);
  void check_cells();
  void count_inside();
  int group_bit(const char* name);
  bigint count(int bits) const;
  [[noreturn]] void violation(const std::string& what) const;

  double mach_limit_ = 0.3;
  int cell_bits_ = 0, carrier_bits_ = 0;
  bigint cell_atoms_ = 0;
  bigint last_ = -1;
  bool started_ = false;
  WatchRecord record_;
  FixHemoFluid* fluid_ = nullptr;
  AngleHemoMembrane* membrane_ = nullptr;
};

}  // namespace LAMMPS_NS

#endif
#endif
