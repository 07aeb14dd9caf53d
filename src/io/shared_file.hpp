#pragma once
#include <string>
#include <vector>

#include <mpi.h>

#include "io/hdf5_handle.hpp"

namespace hemomag::io {

/// Which box of a dataset is this rank's.
struct Box {
  std::vector<hsize_t> whole, start, count;
};

/// An HDF5 file that all ranks have open together, through MPI-IO. All members are collective, and
/// what fails on one rank is thrown on all, by the same call. A file that could not be written is
/// never closed: HDF5 would write what it still holds, each rank waiting for others that have
/// failed. Such a process should end without MPI_Finalize (lammps::end_by_file_trouble).
class SharedFile {
public:
  enum class Open { create, read };
  /// @throws FileError with path and reason
  SharedFile(MPI_Comm comm, const std::string& path, Open how);
  ~SharedFile();

  operator hid_t() const { return file_; }
  const std::string& path() const { return path_; }

  /// A dataset below a group or the file itself, `stored` in the file, `given` in memory.
  void write(hid_t where, const std::string& name, hid_t stored, hid_t given, const Box& box,
             const void* values);
  /// From an open dataset whose extent and type have been looked at.
  void read(hid_t dataset, hid_t given, const Box& box, void* values);

  /// What was written reaches the file.
  void close();

private:
  hid_t open(Open how) const;
  void agree(bool good, const char* failure);

  MPI_Comm comm_;
  std::string path_;
  Hdf5Handle access_, transfer_;
  hid_t file_ = -1;
  bool written_ = false, failed_ = false;
};

}  // namespace hemomag::io
