#pragma once
#include <span>
#include <string>
#include <vector>

#include <mpi.h>

#include "io/hdf5_handle.hpp"
#include "lattice/block.hpp"

namespace hemomag::io {

/// Scalars of every node of a lattice in one HDF5 file, a dataset [z][y][x] each, as they lie in
/// memory: what is read is what was written to the last bit, on any number of ranks. All members
/// are collective. @throws FileError with path and reason, maybe on one rank only
class NodeFile {
public:
  enum class Open { create, read };
  NodeFile(MPI_Comm comm, const std::string& path, const lattice::Block& block, Open how);

  /// @param values  of the owned nodes of this rank, x fastest
  template <class Real> void write(const std::string& name, std::span<const Real> values);
  template <class Real> void read(const std::string& name, std::span<Real> values);

  /// What was written reaches the file.
  void close() { file_.close(path_); }

private:
  hid_t open(MPI_Comm comm, Open how);
  void select_mine(hid_t space) const;

  std::string path_;
  lattice::Block block_;
  Hdf5Handle access_, transfer_, file_;
};

}  // namespace hemomag::io
