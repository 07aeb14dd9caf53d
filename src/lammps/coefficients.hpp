#pragma once
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include <mpi.h>

#include "error.h"
#include "utils.h"

namespace hemomag::lammps {

/// Coefficient columns of a bonded style, one row a type (row 0 unused). A cell's mesh has
/// thousands of types.
template <std::size_t Columns> class Coefficients {
public:
  using Row = std::array<double, Columns>;

  void resize(int types) { rows_.resize(static_cast<std::size_t>(types) + 1); }
  const Row& operator[](int type) const { return rows_[static_cast<std::size_t>(type)]; }
  Row& operator[](int type) { return rows_[static_cast<std::size_t>(type)]; }
  int types() const { return static_cast<int>(rows_.size()) - 1; }

  void write(std::FILE* file) const {
    std::fwrite(rows_[1].data(), sizeof(Row), rows_.size() - 1, file);
  }

  /// Read on rank 0, then told to all. @throws through LAMMPS's error when the file ends early
  void read(std::FILE* file, int me, MPI_Comm world, LAMMPS_NS::Error* error) {
    if (me == 0)
      LAMMPS_NS::utils::sfread(FLERR, rows_[1].data(), sizeof(Row), rows_.size() - 1, file, nullptr,
                               error);
    MPI_Bcast(rows_[1].data(), static_cast<int>((rows_.size() - 1) * Columns), MPI_DOUBLE, 0,
              world);
  }

  void write_data(std::FILE* file) const {
    for (int type = 1; type <= types(); ++type) {
      std::fprintf(file, "%d", type);
      for (const double value : (*this)[type]) std::fprintf(file, " %.17g", value);
      std::fprintf(file, "\n");
    }
  }

private:
  std::vector<Row> rows_;
};

}  // namespace hemomag::lammps
