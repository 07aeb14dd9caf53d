#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <mpi.h>

#include "lattice/block.hpp"

// VTKHDF 1.0 files, written by all ranks together through MPI-IO. ParaView >= 5.10 and VTK >= 9.1
// open them.

namespace hemomag::io {

/// Values of one array on this rank: [n][components].
struct DataArray {
  std::string name;
  int components;
  std::vector<double> values;
};

/// ImageData with a point at every lattice node.
/// @param dx     node spacing; node i lies at (i + 1/2) dx
/// @param arrays on the owned nodes of this rank, x fastest
/// @throws Error with path and reason, on every rank
void write_image(MPI_Comm comm, const std::string& path, const lattice::Block& block, double dx,
                 const std::vector<DataArray>& arrays);

enum class Shape : std::uint8_t { vertex = 1, triangle = 5 };

/// UnstructuredGrid of one kind of cell, one partition a rank that has any.
/// @param points       [n][3]
/// @param connectivity corners of this rank's cells, indices into its own points
void write_grid(MPI_Comm comm, const std::string& path, Shape shape, std::span<const double> points,
                std::span<const std::int64_t> connectivity,
                const std::vector<DataArray>& point_arrays,
                const std::vector<DataArray>& cell_arrays);

}  // namespace hemomag::io
