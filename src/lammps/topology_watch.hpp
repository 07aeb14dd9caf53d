#pragma once
#include "neighbor.h"
#include "pointers.h"

namespace hemomag::lammps {

/// Tells when the lists of bonds, angles and dihedrals have changed, so that what a style derives
/// from them is derived once and not in every step.
class TopologyWatch {
public:
  /// Before a run: coefficients may have changed, and LAMMPS counts its lists from zero again.
  void forget() { seen_ = unknown; }
  /// True on the first call after each new list.
  bool changed(const LAMMPS_NS::Neighbor& neighbor) {
    const bool news = neighbor.ncalls != seen_;
    seen_ = neighbor.ncalls;
    return news;
  }

private:
  static constexpr LAMMPS_NS::bigint unknown = -1;
  LAMMPS_NS::bigint seen_ = unknown;
};

}  // namespace hemomag::lammps
