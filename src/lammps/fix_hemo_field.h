// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/field,FixHemoField)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_FIELD_H
#define LMP_FIX_HEMO_FIELD_H

#include <string>
#include <vector>

#include "fix.h"

#include "magnetic/field.hpp"
#include "magnetic/moment.hpp"

namespace LAMMPS_NS {

/// `fix hemo/field`: external field, induced moments and (m.grad)B (docs/styles/fix_hemo_field.md).
class FixHemoField : public Fix {
public:
  FixHemoField(LAMMPS*, int, char**);
  ~FixHemoField() override;
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void pre_force(int) override;
  void post_force(int) override;
  double compute_scalar() override;
  double compute_vector(int) override;
  double memory_usage() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double*) override;
  int unpack_exchange(int, double*) override;
  int pack_forward_comm(int, int*, double*, int, int*) override;
  void unpack_forward_comm(int, int, double*) override;

  /// Moments of owned and ghost carriers, [nmax][3]; valid from pre_force on. Zero for other atoms.
  double** moments() { return moment_; }

private:
  void parse(const std::vector<std::string>& words);
  hemomag::magnetic::Magnetisation& of_type(const std::string& word);

  std::vector<hemomag::magnetic::Magnetisation> magnetisation_;  // by type
  hemomag::magnetic::Field field_;
  double** moment_ = nullptr;
  std::vector<hemomag::Vec3> force_;  // of owned atoms, from pre_force to post_force
  double sums_[4] = {};               // energy, force, on this rank in the last step
};

}  // namespace LAMMPS_NS

#endif
#endif
