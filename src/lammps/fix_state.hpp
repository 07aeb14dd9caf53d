#pragma once
#include <cstdio>
#include <cstring>
#include <vector>

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
  /// Those not read yet.
  std::vector<double> rest() const {
    return {numbers_.begin() + static_cast<std::ptrdiff_t>(at_), numbers_.end()};
  }

private:
  std::vector<double> numbers_;
  std::size_t at_ = 0;
};

}  // namespace hemomag::lammps
