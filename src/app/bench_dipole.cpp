#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <sstream>
#include <string>

#include <mpi.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "app/bench.hpp"
#include "app/timing.hpp"
#include "case/cells_data.hpp"
#include "case/placement.hpp"
#include "case/script.hpp"
#include "io/files.hpp"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_drag.h"
#include "lammps/host.hpp"

namespace hemomag::app {
namespace {

constexpr int carriers = 10000;
constexpr double radius = 125e-9, d = 2 * radius;
constexpr Vec3 box{27e-6, 36e-6, 24e-6};

/// Carriers of the study in its channel at 0.1 T, without cells and flow.
case_::Case ten_thousand() {
  case_::Case c;
  c.title = "10,000 carriers at 0.1 T";
  c.channel.size = {box.x, box.y, box.z};
  c.channel.boundary = case_::Boundary::periodic;
  c.fluid.viscosity = 1.2e-3;
  c.numerics.dx = 0.5e-6;
  c.numerics.dt = 6.8e-6;
  c.carriers.emplace_back();
  c.carriers[0].count = carriers;
  c.carriers[0].radius = radius;
  c.magnetic.sources.emplace_back();
  c.magnetic.sources[0].field = case_::FieldKind::uniform;
  c.magnetic.sources[0].B0 = 0.1;
  c.run.steps = 1;
  c.output.fields.reset();
  c.output.series.reset();
  return c;
}

/// Squared distance between the nearest periodic images.
double squared_distance(const Vec3& a, const Vec3& b) {
  Vec3 r = a - b;
  for (std::size_t k = 0; k < 3; ++k) r[k] -= box[k] * std::round(r[k] / box[k]);
  return norm2(r);
}

/// Chains of `length` touching carriers along the field, as they form there, at random places.
case_::System chains(int length) {
  std::mt19937_64 bits(1);
  const auto uniform = [&](double high) {
    return high * static_cast<double>(bits() >> 11) * 0x1p-53;
  };
  case_::System system;
  while (system.carriers.size() < carriers) {
    const double x = uniform(box.x), y = uniform(box.y), z = uniform(box.z);
    const auto bead = [&](int b) { return Vec3{x, y, z + b * d}; };
    bool fits = true;
    for (int b = 0; b < length && fits; ++b)
      for (const auto& other : system.carriers)
        if (squared_distance(bead(b), other.beads[0]) < 1.1 * d * d) fits = false;
    for (int b = 0; b < length && fits; ++b) system.carriers.push_back({0, {bead(b)}});
  }
  return system;
}

/// The case's own script up to its first force computation, without its observers.
void start(lammps::Host& host, const case_::Case& c, const case_::System& system) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  int id = static_cast<int>(getpid());
  MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
  const auto data =
      std::filesystem::temp_directory_path() / ("hemomag_bench_" + std::to_string(id) + ".data");
  if (rank == 0) io::replace_file(data.string(), case_::cells_data(c, system));
  MPI_Barrier(MPI_COMM_WORLD);
  std::istringstream script(case_::lammps_script(c, system));
  for (std::string line; std::getline(script, line);) {
    if (line.rfind("fix series", 0) == 0 || line.rfind("fix watch", 0) == 0 ||
        line.rfind("thermo", 0) == 0 || line.rfind("run ", 0) == 0)
      continue;
    host.command(line.rfind("read_data ", 0) == 0 ? "read_data " + data.string() : line);
  }
  host.command("run 1");  // chooses the number of sub-steps
  if (rank == 0) std::filesystem::remove(data);
}

void bench_state(const char* state, int length, bool json) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD);
  start(host, ten_thousand(), chains(length));
  auto* drag = lammps::find_fix<LAMMPS_NS::FixHemoDrag>(&host.lammps(), "hemo/drag");
  const int substeps = drag->substeps();
  const long pairs = drag->pairs();

  std::vector<double> seconds;
  constexpr int steps = 20;
  for (int r = 0; r <= repetitions; ++r) {  // the first round warms up
    const double sum = timed([&] {
      for (int t = 0; t < steps * substeps; ++t) {
        drag->stiff_forces();
        drag->forward_positions();
      }
    });
    if (r > 0) seconds.push_back(sum / steps);
  }
  if (rank != 0) return;
  const double ms = 1e3 * median(seconds);
  if (json)
    std::printf("%s\n", nlohmann::ordered_json{{"case", std::string("dipole, ") + state},
                                               {"ranks", ranks},
                                               {"carriers", carriers},
                                               {"pairs", pairs},
                                               {"substeps", substeps},
                                               {"ms_per_step", ms}}
                            .dump()
                            .c_str());
  else
    std::printf("dipole, 10,000 carriers at 0.1 T, %s, %ld pairs, %d ranks: %.2f ms a step of %d "
                "sub-steps\n",
                state, pairs, ranks, ms, substeps);
}

}  // namespace

void bench_dipole(bool json) {
  bench_state("at random", 1, json);
  bench_state("in chains of 20", 20, json);
}

}  // namespace hemomag::app
