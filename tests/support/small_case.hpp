#pragma once
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <mpi.h>
#include <unistd.h>

#include "atom.h"
#include "lammps.h"

#include "base/vec3.hpp"
#include "case/case.hpp"
#include "case/cells_data.hpp"
#include "case/placement.hpp"
#include "case/script.hpp"
#include "lammps/host.hpp"

namespace hemomag::test {

/// Sheared plasma with a few cells, carriers and a field, without output files.
inline case_::Case small_case() {
  case_::Case c;
  c.title = "small case";
  c.channel.size = {9e-6, 14e-6, 9e-6};
  c.channel.shear_rate = 200;
  c.fluid.viscosity = 1.2e-3;
  c.numerics.dx = 0.5e-6;
  c.numerics.cell_reynolds = 0.5;
  c.cells.emplace_back();
  c.cells[0].vertices = 642;
  c.cells[0].count = 2;
  c.carriers.emplace_back();
  c.carriers[0].count = 12;
  c.carriers[0].radius = 125e-9;
  c.magnetic.sources.emplace_back();  // of the gradient
  c.magnetic.sources[0].B0 = 0.1;
  c.run.steps = 200;
  c.output.fields.reset();
  c.output.series.reset();
  return c;
}

struct State {
  std::vector<Vec3> x, f;  ///< by tag - 1, positions unwrapped; on every rank of the communicator
};

/// Run a case's own script on a communicator, its data file in a directory of its own.
/// @param steps  instead of the case's
/// @param each   called after the run with the host, e.g. to read what styles know
template <class Each>
State run_case_on(MPI_Comm comm, const case_::Case& c, const case_::System& system, Each each) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  int id = static_cast<int>(getpid());
  MPI_Bcast(&id, 1, MPI_INT, 0, comm);
  const auto directory =
      std::filesystem::temp_directory_path() / ("hemomag_case_" + std::to_string(id));
  if (rank == 0) {
    std::filesystem::create_directories(directory);
    std::ofstream(directory / "cells.data") << case_::cells_data(c, system);
  }
  MPI_Barrier(comm);
  State state;
  {
    lammps::Host host({"-screen", "none", "-log", "none"}, comm);
    std::string script = case_::lammps_script(c, system);
    const std::string name = "read_data cells.data";
    script.replace(script.find(name), name.size(),
                   "read_data " + (directory / "cells.data").string());
    std::string line;
    for (const char ch : script) {
      if (ch != '\n') {
        line += ch;
        continue;
      }
      if (line.rfind("fix series", 0) != 0) host.command(line);  // no files here
      line.clear();
    }
    auto* atom = host.lammps().atom;
    const auto n = static_cast<std::size_t>(atom->natoms);
    std::vector<double> mine(6 * n, 0.0), all(6 * n);
    const auto size = c.channel.size;
    for (int i = 0; i < atom->nlocal; ++i) {
      const auto at = 6 * static_cast<std::size_t>(atom->tag[i] - 1);
      for (std::size_t d = 0; d < 3; ++d) {
        const int shift = d == 0 ? 0 : d == 1 ? IMGBITS : IMG2BITS;
        const int image = static_cast<int>((atom->image[i] >> shift) & IMGMASK) - IMGMAX;
        mine[at + d] = atom->x[i][d] + image * size[d] / c.numerics.dx;
        mine[at + 3 + d] = atom->f[i][d];
      }
    }
    MPI_Allreduce(mine.data(), all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, comm);
    for (std::size_t k = 0; k < n; ++k) {
      state.x.push_back({all[6 * k], all[6 * k + 1], all[6 * k + 2]});
      state.f.push_back({all[6 * k + 3], all[6 * k + 4], all[6 * k + 5]});
    }
    each(host);
  }
  MPI_Barrier(comm);
  if (rank == 0) std::filesystem::remove_all(directory);
  return state;
}

}  // namespace hemomag::test
