// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/cells,FixHemoCells)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_CELLS_H
#define LMP_FIX_HEMO_CELLS_H

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fix.h"

namespace hemomag::io {
class CsvFile;
}

namespace LAMMPS_NS {

class ComputeHemoCell;

/// `fix hemo/cells`: shape and phase of every cell against time in a CSV file
/// (docs/styles/fix_hemo_cells.md).
class FixHemoCells : public Fix {
public:
  FixHemoCells(LAMMPS*, int, char**);
  ~FixHemoCells() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  void write_restart(FILE*) override;
  void restart(char*) override;

private:
  void write();

  int write_every_ = 0, follow_every_ = 0;
  std::string compute_id_, path_;
  double dx_um_ = 1, dt_s_ = 1;
  ComputeHemoCell* compute_ = nullptr;
  std::unique_ptr<hemomag::io::CsvFile> file_;
  bigint last_ = -1;
  std::optional<long> resumed_at_;  // length of the file at the restart
  std::vector<double> followed_;    // from the restart, for the compute
};

}  // namespace LAMMPS_NS

#endif
#endif
