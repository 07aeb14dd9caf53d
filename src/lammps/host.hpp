#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include <mpi.h>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace hemomag::lammps {

/// One LAMMPS instance that knows the hemo styles. Its fatal errors end the process, by exit(1)
/// when all ranks meet them and by MPI_Abort when one does, as in LAMMPS itself.
class Host {
public:
  /// @param arguments  LAMMPS command-line options, without the program name, e.g. {"-screen",
  /// "none"}
  Host(std::vector<std::string> arguments, MPI_Comm comm);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  LAMMPS_NS::LAMMPS& lammps() { return *lmp_; }
  /// Ranks along each axis of the box.
  std::array<int, 3> rank_grid() const;

  /// Keep LAMMPS's messages on a rank other than 0, which has no log: in kept_log().
  void keep_log();

  /// Execute one line of LAMMPS input.
  void command(const std::string& line);
  /// Execute a script file, or standard input as given by `-in` when `path` is empty.
  void script(const std::string& path = {});

private:
  std::vector<std::string> arguments_;  // LAMMPS keeps pointers into these
  std::unique_ptr<LAMMPS_NS::LAMMPS> lmp_;
};

}  // namespace hemomag::lammps
