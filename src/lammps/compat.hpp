#pragma once
#include <string>

#include "error.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"

#include "base/error.hpp"

// What differs between LAMMPS releases, and the few idioms every style repeats. Written for 29 Sep 2021.

namespace hemomag::lammps {

/// The first fix of a style, or nullptr.
template <class Style>
Style* find_fix(LAMMPS_NS::LAMMPS* lmp, const char* style) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (std::string(lmp->modify->fix[i]->style) == style) return dynamic_cast<Style*>(lmp->modify->fix[i]);
  return nullptr;
}

/// Run `work`, handing a hemomag::Error to LAMMPS as a fatal error on every rank.
template <class Work>
void or_fail(LAMMPS_NS::LAMMPS* lmp, const char* file, int line, Work work) {
  try {
    work();
  } catch (const Error& e) {
    lmp->error->all(file, line, std::string(e.what()));
  }
}

}  // namespace hemomag::lammps
