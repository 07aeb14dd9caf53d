#pragma once
#include <array>

#include <mpi.h>

#include "solver/neighbourhood.hpp"

namespace hemomag::test {

/// The whole of MPI_COMM_WORLD as bricks over a grid; `plate_axis` (or -1) is not periodic.
inline solver::Neighbourhood neighbourhood(std::array<int, 3> nodes, int plate_axis) {
  int ranks = 1, rank = 0, grid[3] = {0, 0, 0};
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Dims_create(ranks, 3, grid);
  const int at[3] = {rank % grid[0], rank / grid[0] % grid[1], rank / (grid[0] * grid[1])};
  const auto rank_of = [&](int x, int y, int z) { return x + grid[0] * (y + grid[1] * z); };
  solver::Neighbourhood here;
  here.comm = MPI_COMM_WORLD;
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
      here.neighbour[d][side] =
          outside && d == plate_axis ? MPI_PROC_NULL : rank_of(other[0], other[1], other[2]);
    }
  }
  return here;
}

inline double sum_over_ranks(double mine) {
  double all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

}  // namespace hemomag::test
