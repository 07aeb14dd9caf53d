#pragma once
#include <memory>
#include <string>
#include <vector>

#include <mpi.h>

#include "base/error.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace hemomag::lammps {

/// A fatal error that only some ranks met: the others may be waiting for them, so that the run has to be aborted.
class OneRankError : public Error {
 public:
  using Error::Error;
};

/// One LAMMPS instance that knows the hemo styles. Its fatal errors arrive as Error (met by all ranks) or OneRankError.
class Host {
 public:
  /// @param arguments  LAMMPS command-line options, without the program name, e.g. {"-screen", "none"}
  Host(std::vector<std::string> arguments, MPI_Comm comm);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  LAMMPS_NS::LAMMPS& lammps() { return *lmp_; }

  /// Execute one line of LAMMPS input.
  void command(const std::string& line);
  /// Execute a script file, or standard input as given by `-in` when `path` is empty.
  void script(const std::string& path = {});

 private:
  template <class Work>
  void guarded(Work work);

  std::vector<std::string> arguments_;  // LAMMPS keeps pointers into these
  std::unique_ptr<LAMMPS_NS::LAMMPS> lmp_;
};

}  // namespace hemomag::lammps
