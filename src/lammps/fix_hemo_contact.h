// clang-format off
#ifdef FIX_CLASS
FixStyle(hemo/contact,FixHemoContact)
#else
// clang-format on

#ifndef LMP_FIX_HEMO_CONTACT_H
#define LMP_FIX_HEMO_CONTACT_H

#include <vector>

#include "fix.h"

#include "contact/surface_barrier.hpp"
#include "lammps/topology_watch.hpp"

namespace LAMMPS_NS {

class AngleHemoMembrane;

/// `fix hemo/contact`: carriers against the triangles of membranes
/// (docs/styles/fix_hemo_contact.md).
class FixHemoContact : public Fix {
public:
  FixHemoContact(LAMMPS*, int, char**);
  int setmask() override;
  void init() override;
  void setup_pre_reverse(int, int) override;
  void pre_reverse(int, int) override;
  double compute_scalar() override;
  double memory_usage() override;

private:
  /// A triangle of this rank and an owned or ghost carrier that may come within its range before
  /// the next list.
  struct Meeting {
    int corner[3];
    int carrier;
  };
  void list_meetings();

  hemomag::contact::SurfaceBarrier barrier_;
  AngleHemoMembrane* membrane_ = nullptr;
  hemomag::lammps::TopologyWatch topology_;
  std::vector<Meeting> meetings_;
  double energy_ = 0;  // of this rank, in the last step
};

}  // namespace LAMMPS_NS

#endif
#endif
