#pragma once
#include <algorithm>
#include <vector>

#include <mpi.h>

namespace hemomag::app {

inline constexpr int repetitions = 5;  ///< of a measurement, after one that warms up

/// Seconds of `work` between barriers. Collective.
template <class Work> double timed(Work work) {
  MPI_Barrier(MPI_COMM_WORLD);
  const double start = MPI_Wtime();
  work();
  MPI_Barrier(MPI_COMM_WORLD);
  return MPI_Wtime() - start;
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace hemomag::app
