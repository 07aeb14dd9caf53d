#pragma once
#include <array>
#include <utility>

#include <mpi.h>

#include "solver/neighbourhood.hpp"

namespace hemomag::solver {

/// All ranks of a communicator as bricks over a grid of nodes, for a fluid without LAMMPS.
/// @param plate_axis  the axis that is closed by plates, or -1; the others are periodic
inline Neighbourhood bricks(MPI_Comm comm, std::array<int, 3> nodes, int plate_axis) {
  int ranks = 1, rank = 0, grid[3] = {0, 0, 0};
  MPI_Comm_size(comm, &ranks);
  MPI_Comm_rank(comm, &rank);
  // The split with the least surface, as LAMMPS makes it.
  double least = -1;
  for (int x = 1; x <= ranks; ++x)
    for (int y = 1; x * y <= ranks; ++y) {
      if (ranks % (x * y) != 0) continue;
      const int z = ranks / (x * y);
      const double a = static_cast<double>(nodes[0]) / x, b = static_cast<double>(nodes[1]) / y,
                   c = static_cast<double>(nodes[2]) / z, surface = a * b + b * c + c * a;
      if (least >= 0 && surface >= least) continue;
      least = surface;
      grid[0] = x, grid[1] = y, grid[2] = z;
    }
  const int at[3] = {rank % grid[0], rank / grid[0] % grid[1], rank / (grid[0] * grid[1])};
  const auto rank_of = [&](const int(&p)[3]) { return p[0] + grid[0] * (p[1] + grid[1] * p[2]); };
  Neighbourhood here;
  here.comm = comm;
  here.rank = rank;
  for (int d = 0; d < 3; ++d) {
    here.block.global[d] = nodes[d];
    here.block.begin[d] = lattice::first_node(nodes[d], grid[d], at[d]);
    here.block.size[d] = lattice::first_node(nodes[d], grid[d], at[d] + 1) - here.block.begin[d];
    for (int side = 0; side < 2; ++side) {
      int other[3] = {at[0], at[1], at[2]};
      other[d] += side == 0 ? -1 : 1;
      const bool outside = other[d] < 0 || other[d] >= grid[d];
      other[d] = (other[d] + grid[d]) % grid[d];
      here.neighbour[d][side] = outside && d == plate_axis ? MPI_PROC_NULL : rank_of(other);
    }
  }
  return here;
}

}  // namespace hemomag::solver
