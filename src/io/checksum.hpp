#pragma once
#include <cstdint>
#include <string>

#include <mpi.h>

namespace hemomag::io {

/// Checksum of a file: XXH3 (64 bits) of the sizes and XXH3 sums of its pieces of 64 MiB, so that
/// all ranks share the reading and any number of them gets the same. Collective.
/// @throws FileError with path and reason, on every rank
std::uint64_t checksum(MPI_Comm comm, const std::string& path);

/// XXH3 (64 bits) of a text.
std::uint64_t checksum_of(const std::string& text);

}  // namespace hemomag::io
