#pragma once
#include <cstdio>
#include <string>

#include "compute.h"
#include "error.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"

#include "base/error.hpp"

// What differs between LAMMPS releases, and the few idioms every style repeats. Written for 29 Sep
// 2021.

namespace hemomag::lammps {

/// The first fix of a style, or nullptr.
template <class Style> Style* find_fix(LAMMPS_NS::LAMMPS* lmp, const char* style) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (std::string(lmp->modify->fix[i]->style) == style)
      return dynamic_cast<Style*>(lmp->modify->fix[i]);
  return nullptr;
}

/// The compute of that name, or nullptr when there is none or it is of another style.
template <class Style> Style* find_compute(LAMMPS_NS::LAMMPS* lmp, const std::string& id) {
  const int found = lmp->modify->find_compute(id);
  return found < 0 ? nullptr : dynamic_cast<Style*>(lmp->modify->compute[found]);
}

/// A fatal error that this rank alone has met. LAMMPS 29 Sep 2021 aborts all ranks here, with its
/// message on the screen, which a quiet run has turned off: then the message goes to standard
/// error.
[[noreturn]] inline void fail_here(LAMMPS_NS::LAMMPS* lmp, const char* file, int line,
                                   const std::string& message) {
  if (!lmp->screen) std::fprintf(stderr, "hemomag: %s\n", message.c_str());
  lmp->error->one(file, line, message);
}

/// Run `work`, handing a hemomag::Error to LAMMPS as a fatal error on every rank.
template <class Work> void or_fail(LAMMPS_NS::LAMMPS* lmp, const char* file, int line, Work work) {
  try {
    work();
  } catch (const Error& e) {
    lmp->error->all(file, line, std::string(e.what()));
  }
}

}  // namespace hemomag::lammps
