#pragma once

// LAMMPS ends the process itself when it meets a fatal error: by exit(1) on all ranks, or by
// MPI_Abort from one. While a case runs these are turned into the exit code of a run that went
// unstable, with LAMMPS's message on the terminal, which a quiet run would otherwise keep in its
// log.

namespace hemomag::case_ {

/// Marks the time in which an end of the process means that the run broke off. The working
/// directory is the run's.
class RunInProgress {
public:
  explicit RunInProgress(int rank);
  ~RunInProgress();
  RunInProgress(const RunInProgress&) = delete;
  RunInProgress& operator=(const RunInProgress&) = delete;
};

/// Name of the checkpoints' directory in that of the run.
inline constexpr const char* checkpoint_name = "checkpoint";

/// Exit code for an MPI_Abort at this moment: while a run is in progress 3, or 4 for a file or the
/// disk, else 1. Prints the reason.
int code_of_abort();

}  // namespace hemomag::case_
