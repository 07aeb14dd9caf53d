#define XXH_INLINE_ALL  // Debian's header is the whole library
#include "io/checksum.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include <xxhash.h>

#include "base/error.hpp"

namespace hemomag::io {
namespace {

constexpr std::uint64_t piece = std::uint64_t{64} << 20;

struct Close {
  void operator()(std::FILE* f) const { std::fclose(f); }
};

/// Sum of piece number k, or 0 with `failed` set.
std::uint64_t sum_of_piece(std::FILE* file, std::uint64_t k, std::uint64_t bytes,
                           std::vector<char>& buffer, int& failed) {
  const std::uint64_t begin = k * piece, size = std::min(piece, bytes - begin);
  buffer.resize(size);
  if (!file || fseeko(file, static_cast<off_t>(begin), SEEK_SET) != 0 ||
      std::fread(buffer.data(), 1, size, file) != size)
    failed = 1;
  return failed ? 0 : XXH3_64bits(buffer.data(), size);
}

}  // namespace

std::uint64_t checksum(MPI_Comm comm, const std::string& path) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  // Rank 0 says how long the file is: all must agree on the pieces.
  std::error_code error;
  std::uint64_t bytes = std::filesystem::file_size(path, error);
  int failed = error ? 1 : 0;
  MPI_Bcast(&bytes, 1, MPI_UINT64_T, 0, comm);
  MPI_Bcast(&failed, 1, MPI_INT, 0, comm);
  if (failed) throw FileError(path + ": cannot be read");

  const std::uint64_t pieces = (bytes + piece - 1) / piece;
  std::vector<std::uint64_t> sums(pieces + 1, 0);
  sums[pieces] = rank == 0 ? bytes : 0;
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  std::vector<char> buffer;
  for (auto k = static_cast<std::uint64_t>(rank); k < pieces;
       k += static_cast<std::uint64_t>(ranks))
    sums[k] = sum_of_piece(file.get(), k, bytes, buffer, failed);
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, comm);
  if (failed) throw FileError(path + ": cannot be read");
  // Every piece has one reader; the others add zeros.
  // NOLINTNEXTLINE(mpi-type-mismatch): it sees what uint64_t stands for, not the name
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_UINT64_T, MPI_SUM,
                comm);
  return XXH3_64bits(sums.data(), sums.size() * sizeof(std::uint64_t));
}

std::uint64_t checksum_of(const std::string& text) { return XXH3_64bits(text.data(), text.size()); }

}  // namespace hemomag::io
