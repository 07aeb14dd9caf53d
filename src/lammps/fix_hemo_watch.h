// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/watch,FixHemoWatch)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_WATCH_H
#define LMP_FIX_HEMO_WATCH_H

#include <map>
#include <string>

#include "fix.h"

namespace LAMMPS_NS {

class FixHemoFluid;
class AngleHemoMembrane;
class BondHemoWLC;

/// `fix hemo/watch`: is the run still sound? (docs/styles/fix_hemo_watch.md)
class FixHemoWatch : public Fix {
public:
  struct WatchRecord {
    bigint cells_start = 0, cells_end = 0;
    bigint carriers_start = 0, carriers_end = 0;
    bigint carriers_inside_max = 0;  ///< carriers found inside cells at one time
    double mach_max = 0;
    double displacement_max = 0;                      ///< of an atom in a step, in nodes
    double stretch_max = 0;                           ///< length of an edge over its limit
    double seconds = 0;                               ///< spent by this process, waiting included
    double area_drift_max = 0, volume_drift_max = 0;  ///< largest |A/A0 - 1|, |V/V0 - 1| of a cell
  };

  FixHemoWatch(LAMMPS*, int, char**);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_integrate() override;
  void final_integrate() override;
  void end_of_step() override;
  void post_run() override;
  double compute_vector(int) override;
  void write_restart(FILE*) override;
  void restart(char*) override;

  const WatchRecord& record() const { return record_; }
  /// End the run now if it is not sound; nothing is recorded. Collective.
  void verify();
  /// What this rank alone has met (accident.hpp): the run ends before this step does.
  void note(const std::string& accident);

private:
  /// What one look finds.
  struct Seen {
    bigint cells = 0, cell_atoms = 0, carriers = 0;
    double mach = 0, displacement = 0, stretch = 0, area_drift = 0, volume_drift = 0;
  };

  void look();
  Seen inspect();
  void check_plates();
  void check_motion();
  void check_accidents();
  void check_finite();
  double check_displacement();
  double check_mach();
  void check_counts(Seen& seen);
  double check_stretch();
  void check_cells(Seen& seen);
  void count_inside();
  int group_bit(const char* name);
  bigint count(int bits) const;
  std::string name_of(int i) const;
  std::string too_fast(int i) const;
  [[noreturn]] void violation(int rank, const std::string& what);

  double mach_limit_ = 0.3;
  double displacement_limit_ = 0.5;  // nodes
  int cell_bits_ = 0, carrier_bits_ = 0;
  int looks_inside_ = 0;    // after which a carrier in a cell ends the run; 0: never
  std::string inspection_;  // arguments of the snapshot that a violation leaves
  bigint cell_atoms_ = 0;
  bigint last_ = -1;
  std::string accident_;  // the first that this rank has met, or empty
  bool started_ = false, resumed_ = false;
  WatchRecord record_;
  std::map<tagint, int> inside_;  // carriers inside cells, and for how many looks
  FixHemoFluid* fluid_ = nullptr;
  AngleHemoMembrane* membrane_ = nullptr;
  BondHemoWLC* springs_ = nullptr;
};

}  // namespace LAMMPS_NS

#endif
#endif
