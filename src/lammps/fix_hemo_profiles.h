// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/profiles,FixHemoProfiles)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_PROFILES_H
#define LMP_FIX_HEMO_PROFILES_H

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fix.h"

#include "analysis/apparent_viscosity.hpp"
#include "analysis/profiles.hpp"

namespace hemomag::analysis {
class FacingSurfaces;
}
namespace hemomag::io {
class CsvFile;
}

namespace LAMMPS_NS {

class FixHemoFluid;
class AngleHemoMembrane;

/// `fix hemo/profiles`: hematocrit and velocity across the channel, the cell-free layer and the
/// drag on the plates (docs/styles/fix_hemo_profiles.md).
class FixHemoProfiles : public Fix {
public:
  /// A mean over the samples from average_from on (all samples when there is none) and the standard
  /// deviation of one sample.
  struct Mean {
    double mean = 0, deviation = 0;
  };
  /// Lengths in um, stress in Pa, both as far as the fix was told its units.
  struct Results {
    long samples = 0;
    std::array<Mean, 2> layer, seen;  ///< lower and upper plate
    std::array<double, 2> half_core;  ///< where the mean hematocrit reaches half of its core's
    double hematocrit = 0;            ///< over the channel
    std::array<Mean, 2> drag;         ///< on the lower and the upper plate, along y
    Mean velocity;                    ///< over the channel [mm/s]
    std::optional<double> relative_viscosity;  ///< apparent over the fluid's own
  };

  FixHemoProfiles(LAMMPS*, int, char**);
  ~FixHemoProfiles() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  void post_run() override;
  void write_restart(FILE*) override;
  void restart(char*) override;
  double compute_vector(int) override;

  Results results() const;

private:
  /// What one sample holds besides hematocrit and velocity of each slab.
  enum Scalar { layer, seen = layer + 2, drag = seen + 2, velocity = drag + 2, scalars };

  void sample();
  void add_share();
  void measure_drag();
  void measure_cells();
  void measure_fluid();
  void write_row() const;
  void write_profiles() const;
  hemomag::analysis::PlateFlow mean_flow(const hemomag::analysis::Moments& m) const;
  const hemomag::analysis::Moments& averaged() const { return late_.count() > 0 ? late_ : all_; }
  Mean mean_of(std::size_t k, double unit) const;

  std::string profile_path_, series_path_;
  double dx_um_ = 1, dt_s_ = 1, stress_pa_ = 1, average_from_ = 0, spacing_ = 0.5;
  bigint sample_every_ = 0, last_ = -1;
  std::size_t slabs_ = 0;
  FixHemoFluid* fluid_ = nullptr;
  AngleHemoMembrane* membrane_ = nullptr;
  std::unique_ptr<hemomag::analysis::FacingSurfaces> facing_;
  std::array<double, 2> share_sum_{};  // of this rank, since the last sample
  std::array<double, 2> booked_{};     // wall_book of the fluid at the last sample
  long share_steps_ = 0, booked_steps_ = 0;
  std::vector<double> now_;  // [hematocrit of slabs][velocity of slabs][Scalar]
  hemomag::analysis::Moments all_, late_;
  std::unique_ptr<hemomag::io::CsvFile> series_;
  std::optional<long> resumed_at_;  // length of the series file at the checkpoint
};

}  // namespace LAMMPS_NS

#endif
#endif
