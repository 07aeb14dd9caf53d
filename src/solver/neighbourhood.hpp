#pragma once
#include <array>

#include <mpi.h>

#include "lattice/block.hpp"

namespace hemomag::solver {

/// A rank's place on the processor grid: its block of nodes and its six face neighbours.
struct Neighbourhood {
  MPI_Comm comm = MPI_COMM_NULL;
  int rank = 0;
  lattice::Block block;
  /// neighbour[axis][0 low, 1 high]; MPI_PROC_NULL where the grid ends (a plate)
  std::array<std::array<int, 2>, 3> neighbour{};
};

}  // namespace hemomag::solver
