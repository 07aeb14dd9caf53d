#pragma once
#include <array>

#include <mpi.h>

#include "case/case.hpp"

namespace hemomag::case_ {

using RankGrid = std::array<int, 3>;

/// The ranks along each axis, as LAMMPS lays them out in the case's box. Collective.
RankGrid rank_grid(const Case& c, MPI_Comm comm);

/// The brick of every rank must hold the nodes that the coupling reaches beyond one.
/// @throws Error at channel.size
void require_bricks(const Case& c, const RankGrid& ranks);

}  // namespace hemomag::case_
