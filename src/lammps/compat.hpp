#pragma once
#include <string>

#include "compute.h"
#include "error.h"
#include "fix.h"
#include "lammps.h"
#include "modify.h"

#include "base/error.hpp"
#include "lammps/ending.hpp"

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
/// message on the screen, which a quiet run has turned off: then the program that ends says it.
[[noreturn]] inline void fail_here(LAMMPS_NS::LAMMPS* lmp, const char* file, int line,
                                   const std::string& message) {
  if (!lmp->screen) ending().reason = message;
  lmp->error->one(file, line, message);
}

/// The same for an exception; one of a file or the disk sets the exit code.
[[noreturn]] inline void fail_here(LAMMPS_NS::LAMMPS* lmp, const char* file, int line,
                                   const Error& e) {
  if (dynamic_cast<const FileError*>(&e)) {
    ending() = {Cause::file_trouble, e.what()};
    lmp->error->one(file, line, std::string(e.what()));
  }
  fail_here(lmp, file, line, std::string(e.what()));
}

/// Run `work`, handing a hemomag::Error of any rank to LAMMPS as a fatal error on every rank.
/// Collective.
template <class Work> void or_fail(LAMMPS_NS::LAMMPS* lmp, const char* file, int line, Work work) {
  std::string message;
  int mine[2] = {0, 0}, any[2];  // failed, by a file
  try {
    work();
  } catch (const Error& e) {
    message = e.what();
    mine[0] = 1;
    mine[1] = dynamic_cast<const FileError*>(&e) != nullptr;
  }
  MPI_Allreduce(mine, any, 2, MPI_INT, MPI_MAX, lmp->world);
  if (!any[0]) return;
  // The lowest rank that failed says why.
  int rank = 0, ranks = 1;
  MPI_Comm_rank(lmp->world, &rank);
  MPI_Comm_size(lmp->world, &ranks);
  int speaker = mine[0] ? rank : ranks;
  MPI_Allreduce(MPI_IN_PLACE, &speaker, 1, MPI_INT, MPI_MIN, lmp->world);
  int length = static_cast<int>(message.size());
  MPI_Bcast(&length, 1, MPI_INT, speaker, lmp->world);
  message.resize(static_cast<std::size_t>(length));
  MPI_Bcast(message.data(), length, MPI_CHAR, speaker, lmp->world);
  if (any[1]) end_by_file_trouble(lmp->world, lmp->logfile, message);
  lmp->error->all(file, line, message);
}

}  // namespace hemomag::lammps
