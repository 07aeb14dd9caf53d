#pragma once
#include <string>

#include <mpi.h>

#include "case/case.hpp"
#include "case/packing.hpp"
#include "case/run.hpp"

namespace hemomag::case_ {

/// Where a packing reports on itself.
inline constexpr const char* packing_report = "pack.json";

/// `hemomag pack`: make the cells of a case and keep them in a directory, as packed.data, with
/// pack.json and the case. Rank 0 works alone; every rank returns the same exit code
/// (docs/command_line.md).
int pack_case(const Case& c, const RunOptions& options, MPI_Comm comm);

/// What a packing came to, for people and as JSON (docs/output.md).
std::string packing_text(const PackingReport& report);
std::string packing_json(const PackingReport& report);

}  // namespace hemomag::case_
