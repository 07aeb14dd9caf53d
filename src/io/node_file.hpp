#pragma once
#include <span>
#include <string>

#include <mpi.h>

#include "io/shared_file.hpp"
#include "lattice/block.hpp"

namespace hemomag::io {

/// Scalars of every node of a lattice in one HDF5 file, a dataset [z][y][x] each, as they lie in
/// memory: what is read is what was written to the last bit, on any number of ranks. All members
/// are collective. @throws FileError with path and reason, on every rank
class NodeFile {
public:
  using Open = SharedFile::Open;
  NodeFile(MPI_Comm comm, const std::string& path, const lattice::Block& block, Open how)
      : block_(block), file_(comm, path, how) {}

  /// @param values  of the owned nodes of this rank, x fastest
  template <class Real> void write(const std::string& name, std::span<const Real> values);
  template <class Real> void read(const std::string& name, std::span<Real> values);

  /// What was written reaches the file.
  void close() { file_.close(); }

private:
  Box mine() const;

  lattice::Block block_;
  SharedFile file_;
};

}  // namespace hemomag::io
