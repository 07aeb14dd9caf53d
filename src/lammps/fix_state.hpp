#pragma once
#include <cstdio>
#include <cstring>
#include <vector>

#include <mpi.h>

#include "base/error.hpp"

namespace hemomag::lammps {

/// The numbers by which a fix goes on after a restart, in LAMMPS's restart file. Whole numbers up
/// to 2^53 are exact.
inline void write_state(std::FILE* file, int me, const std::vector<double>& numbers) {
  if (me != 0) return;
  const double count = static_cast<double>(numbers.size());
  const int bytes = static_cast<int>((numbers.size() + 1) * sizeof(double));
  std::fwrite(&bytes, sizeof bytes, 1, file);
  std::fwrite(&count, sizeof count, 1, file);
  std::fwrite(numbers.data(), sizeof(double), numbers.size(), file);
}

/// Numbers that every rank has of its own, led by the number of ranks. Collective.
inline std::vector<double> of_each_rank(MPI_Comm comm, const std::vector<double>& mine) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  const int count = static_cast<int>(mine.size());
  std::vector<double> all(1 + mine.size() * static_cast<std::size_t>(ranks));
  all[0] = ranks;
  MPI_Allgather(mine.data(), count, MPI_DOUBLE, all.data() + 1, count, MPI_DOUBLE, comm);
  return all;
}

/// Reads them back in the order they were written.
class StateReader {
public:
  explicit StateReader(const char* buffer) {
    double count = 0;
    std::memcpy(&count, buffer, sizeof count);
    numbers_.resize(static_cast<std::size_t>(count));
    std::memcpy(numbers_.data(), buffer + sizeof count, numbers_.size() * sizeof(double));
  }
  double number() {
    if (at_ == numbers_.size()) throw Error("the restart file is of another version of this fix");
    return numbers_[at_++];
  }
  template <class Integer> Integer whole() { return static_cast<Integer>(number()); }
  std::vector<double> numbers(std::size_t count) {
    std::vector<double> next(count);
    for (double& value : next) value = number();
    return next;
  }
  /// Of of_each_rank: this rank's own, each of `count`; on another number of ranks rank 0 has the
  /// sums of all.
  std::vector<double> own(MPI_Comm comm, std::size_t count) {
    int ranks = 1, me = 0;
    MPI_Comm_size(comm, &ranks);
    MPI_Comm_rank(comm, &me);
    const int written = whole<int>();
    std::vector<double> mine(count);
    for (int rank = 0; rank < written; ++rank) {
      const auto values = numbers(count);
      for (std::size_t k = 0; k < count; ++k)
        if (written == ranks ? rank == me : me == 0) mine[k] += values[k];
    }
    return mine;
  }
  /// Those not read yet.
  std::vector<double> rest() const {
    return {numbers_.begin() + static_cast<std::ptrdiff_t>(at_), numbers_.end()};
  }

private:
  std::vector<double> numbers_;
  std::size_t at_ = 0;
};

}  // namespace hemomag::lammps
