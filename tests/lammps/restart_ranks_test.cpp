// A checkpoint of two ranks, taken up by one, two and four.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mpi.h>
#include <unistd.h>

#include "case/cells_data.hpp"
#include "case/placement.hpp"
#include "case/script.hpp"
#include "lammps/host.hpp"
#include "lammps/positions.hpp"
#include "support/small_case.hpp"

namespace hemomag::test {
namespace {

/// Run a script on the first `ranks` ranks. @return positions by tag - 1, on rank 0
std::vector<Vec3> run(const std::string& script, int ranks) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm comm;
  MPI_Comm_split(MPI_COMM_WORLD, rank < ranks ? 0 : MPI_UNDEFINED, rank, &comm);
  std::vector<Vec3> x;
  if (comm != MPI_COMM_NULL) {
    {
      lammps::Host host({"-screen", "none", "-log", "none"}, comm);
      std::stringstream lines(script);
      for (std::string line; std::getline(lines, line);) host.command(line);
      x = lammps::positions(host.lammps());
    }
    MPI_Comm_free(&comm);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  return x;
}

TEST(RestartRanks, AgreesAfterTwoHundredSteps) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  int id = static_cast<int>(getpid());
  MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
  const auto home = std::filesystem::current_path();
  const auto directory =
      std::filesystem::temp_directory_path() / ("hemomag_ranks_" + std::to_string(id));
  case_::Case c = small_case();
  c.run.steps = 100;
  const case_::System system = case_::place(c);
  if (rank == 0) {
    std::filesystem::create_directories(directory);
    std::ofstream(directory / "cells.data") << case_::cells_data(c, system);
    std::ofstream(directory / "case.toml") << "kept";
  }
  MPI_Barrier(MPI_COMM_WORLD);
  std::filesystem::current_path(directory);
  run(case_::saving_script(c, system), 2);

  // Each resumed run writes checkpoints of its own, and cuts the series back to this one's.
  if (rank == 0) std::filesystem::copy("checkpoint", "from");
  MPI_Barrier(MPI_COMM_WORLD);
  std::vector<std::vector<Vec3>> ends;
  for (const int ranks : {2, 1, 4}) {
    c.run.steps = 300;
    ends.push_back(run(case_::resumed_script(c, system, "from", 0), ranks));
  }
  std::filesystem::current_path(home);
  if (rank == 0) {
    ASSERT_FALSE(ends[0].empty());
    for (const std::size_t other : {1u, 2u}) {
      double most = 0;
      for (std::size_t i = 0; i < ends[0].size(); ++i)
        most = std::max(most, norm(ends[other][i] - ends[0][i]));
      EXPECT_GT(most, 0);      // sums were taken in another order
      EXPECT_LT(most, 1e-10);  // the issue's own
      std::printf("positions agree to %.2g nodes\n", most);
    }
    std::filesystem::remove_all(directory);
  }
}

}  // namespace
}  // namespace hemomag::test
