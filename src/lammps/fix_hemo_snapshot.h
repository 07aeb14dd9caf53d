// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/snapshot,FixHemoSnapshot)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_SNAPSHOT_H
#define LMP_FIX_HEMO_SNAPSHOT_H

#include <string>
#include <vector>

#include "fix.h"

#include "io/files.hpp"

namespace LAMMPS_NS {

class FixHemoFluid;

/// `fix hemo/snapshot`: fluid, cells and carriers as VTKHDF files
/// (docs/styles/fix_hemo_snapshot.md).
class FixHemoSnapshot : public Fix {
public:
  FixHemoSnapshot(LAMMPS*, int, char**);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  void write_restart(FILE*) override;
  void restart(char*) override;

private:
  void write();
  void write_fluid(const std::string& path);
  void write_cells(const std::string& path);
  void write_carriers(const std::string& path);

  struct Kind {
    const char* name;
    void (FixHemoSnapshot::*write)(const std::string&);
    hemomag::io::SeriesIndex index;
  };
  std::string directory_;
  double dx_um_ = 1, dt_s_ = 1;
  int count_ = 0;
  bigint last_ = -1;
  FixHemoFluid* fluid_ = nullptr;
  std::vector<Kind> kinds_;
  std::vector<std::string> unsynced_;  // files since the last checkpoint
};

}  // namespace LAMMPS_NS

#endif
#endif
