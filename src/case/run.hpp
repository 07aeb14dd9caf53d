#pragma once
#include <string>

#include <mpi.h>

#include "case/case.hpp"

namespace hemomag::case_ {

struct RunOptions {
  std::string out;      ///< run directory
  bool force = false;   ///< replace an existing one
  bool resume = false;  ///< go on from its last checkpoint
};

/// The main job: write the run directory, run it, sum it up. Collective; every rank returns the
/// same exit code (docs/command_line.md). Rank 0 prints.
int run_case(const Case& c, const RunOptions& options, MPI_Comm comm);

}  // namespace hemomag::case_
