#include <array>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>

#include <mpi.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "app/bench.hpp"
#include "app/timing.hpp"
#include "base/simd.hpp"
#include "case/cells_data.hpp"
#include "case/placement.hpp"
#include "case/script.hpp"
#include "io/files.hpp"
#include "lammps/bonded_forces.hpp"
#include "lammps/host.hpp"

namespace hemomag::app {
namespace {

/// 40 cells of 3286 vertices without flow, in a box in which the grid of 4 x 5 x 2 cells gives two
/// ranks the same work. Their border runs through a row of cells.
case_::Case forty_cells() {
  case_::Case c;
  c.title = "40 cells of 3286 vertices";
  c.channel.size = {34e-6, 42e-6, 24e-6};
  c.channel.boundary = case_::Boundary::periodic;
  c.fluid.viscosity = 1.2e-3;
  c.numerics.dx = 0.25e-6;
  c.numerics.dt = 1.7e-6;
  c.cells.emplace_back();
  c.cells[0].vertices = 3286;
  c.cells[0].count = 40;
  c.cells[0].placement = case_::Placement::grid;
  c.run.steps = 1;
  c.output.fields.reset();
  c.output.series.reset();
  return c;
}

/// The case's own script up to its first force computation, without fluid and observers.
void start(lammps::Host& host, const case_::Case& c) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  int id = static_cast<int>(getpid());
  MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
  const auto data =
      std::filesystem::temp_directory_path() / ("hemomag_bench_" + std::to_string(id) + ".data");
  const case_::System system = case_::place(c);
  if (rank == 0) io::replace_file(data.string(), case_::cells_data(c, system));
  MPI_Barrier(MPI_COMM_WORLD);
  std::istringstream script(case_::lammps_script(c, system));
  for (std::string line; std::getline(script, line);) {
    if (line.rfind("fix ", 0) == 0 || line.rfind("thermo", 0) == 0 || line.rfind("run ", 0) == 0)
      continue;
    host.command(line.rfind("read_data ", 0) == 0 ? "read_data " + data.string() : line);
  }
  host.command("run 0");
  if (rank == 0) std::filesystem::remove(data);
}

}  // namespace

void bench_membrane(bool json) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const case_::Case c = forty_cells();
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD);
  start(host, c);
  const lammps::BondedForces forces(host.lammps());

  // The styles follow one another as in a step, so that each finds the caches the other left.
  std::array<std::vector<double>, 3> seconds;
  std::vector<double> together;
  constexpr int steps = 20;
  for (int r = 0; r <= repetitions; ++r) {  // the first round warms up
    std::array<double, 3> sum{};
    for (int t = 0; t < steps; ++t) {
      forces.clear();
      sum[0] += timed([&] { forces.bonds(); });
      sum[1] += timed([&] { forces.angles(); });
      sum[2] += timed([&] { forces.dihedrals(); });
    }
    if (r == 0) continue;
    for (std::size_t s = 0; s < 3; ++s) seconds[s].push_back(sum[s] / steps);
    together.push_back((sum[0] + sum[1] + sum[2]) / steps);
  }
  if (rank != 0) return;
  const double bond = 1e3 * median(seconds[0]), angle = 1e3 * median(seconds[1]),
               dihedral = 1e3 * median(seconds[2]), total = 1e3 * median(together);
  if (json)
    std::printf("%s\n",
                nlohmann::ordered_json{
                    {"case", "membrane"},
                    {"ranks", ranks},
                    {"vertices", forces.atoms()},
                    {"simd", name(simd_level())},
                    {"ms_per_step", total},
                    {"parts", {{"bond", bond}, {"angle", angle}, {"dihedral", dihedral}}}}
                    .dump()
                    .c_str());
  else
    std::printf("membrane, %s, %s, %d ranks: %.2f ms a step (bond %.2f, angle %.2f, dihedral "
                "%.2f)\n",
                c.title.c_str(), name(simd_level()), ranks, total, bond, angle, dihedral);
}

}  // namespace hemomag::app
