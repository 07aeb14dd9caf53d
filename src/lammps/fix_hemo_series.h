// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/series,FixHemoSeries)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_SERIES_H
#define LMP_FIX_HEMO_SERIES_H

#include <memory>
#include <optional>
#include <string>

#include "fix.h"

namespace hemomag::io {
class CsvFile;
}

namespace LAMMPS_NS {

class Compute;

/// `fix hemo/series`: margination against time in a CSV file (docs/styles/fix_hemo_series.md).
class FixHemoSeries : public Fix {
public:
  FixHemoSeries(LAMMPS*, int, char**);
  ~FixHemoSeries() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  double compute_vector(int) override;
  void write_restart(FILE*) override;
  void restart(char*) override;

  double in_layer() const { return in_layer_; }
  double probability_end() const { return probability_; }
  /// Mean over the rows from average_from on; the last value when there is none.
  double probability_mean() const {
    return rows_ > 0 ? sum_ / static_cast<double>(rows_) : probability_;
  }

private:
  void record();

  std::string compute_id_, path_;
  double dt_s_ = 1, average_from_ = 0;
  Compute* compute_ = nullptr;
  std::unique_ptr<hemomag::io::CsvFile> file_;
  double in_layer_ = 0, probability_ = 0, sum_ = 0;
  long rows_ = 0;
  bigint last_ = -1;
  std::optional<long> carriers_at_start_, resumed_at_;  // after a restart; the file's length
};

}  // namespace LAMMPS_NS

#endif
#endif
