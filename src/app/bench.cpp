#include "app/bench.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>

#include <mpi.h>
#include <nlohmann/json.hpp>

#include "app/timing.hpp"
#include "base/aligned.hpp"
#include "solver/bricks.hpp"
#include "solver/fluid_solver.hpp"

namespace hemomag::app {
namespace {

/// to = 2 from: one array read, one written, which is first fetched. (A plain copy may become a
/// call that bypasses the caches, which the fluid cannot.)
void scale(const AlignedArray<double>& from, AlignedArray<double>& to) {
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = 2 * from[i];
}

/// The study's grid with plates, point forces and velocities on: updates a second beside the
/// machine's copy rate.
void bench_fluid(bool json) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const std::array<int, 3> nodes{108, 144, 96};
  const double updates = 108. * 144 * 96;
  struct Variant {
    const char* scheme;
    fluid::Relaxation relaxation;
    solver::Precision precision;
    double bytes_per_update() const {
      // 19 populations read and written in place, 3 forces read, 3 velocities written and first
      // fetched; the exponential scheme also reads 10 numbers of one step and replaces 10 of
      // another.
      const bool exponential = relaxation.collision == fluid::Collision::exponential;
      const double numbers = 19 * 2 + 3 + 3 * 2 + (exponential ? 10 + 10 * 2 : 0);
      return numbers * (precision == solver::Precision::single_ ? 4 : 8);
    }
    const char* precision_name() const {
      return precision == solver::Precision::single_ ? "single" : "double";
    }
  };
  using enum solver::Precision;
  const std::vector<Variant> variants = {
      {"trt", {1.0, 3.0 / 16}, double_},
      {"bgk", fluid::Relaxation::bgk(1.0), double_},
      {"exponential", fluid::Relaxation::exponential(0.5), double_},
      {"trt", {1.0, 3.0 / 16}, single_},
      {"exponential", fluid::Relaxation::exponential(0.5), single_}};
  std::vector<std::unique_ptr<solver::FluidSolver>> fluids;
  for (const Variant& variant : variants) {
    solver::FluidParameters p;
    p.relaxation = variant.relaxation;
    p.precision = variant.precision;
    p.plate_axis = 2;
    p.plate_velocity[1] = {0, 0.03, 0};
    fluids.push_back(solver::make_fluid(solver::bricks(MPI_COMM_WORLD, nodes, 2), p));
    fluids.back()->initialise([](const Vec3&) { return solver::FluidSolver::Flow{}; });
  }
  constexpr std::size_t copied = std::size_t{1} << 24;
  AlignedArray<double> from(copied), to(copied);

  std::vector<double> copy_seconds;
  std::vector<std::vector<double>> step_seconds(variants.size());
  constexpr int steps = 10;
  for (int r = 0; r <= repetitions; ++r) {  // the first round warms up
    const double copy = timed([&] { scale(from, to); });
    if (r > 0) copy_seconds.push_back(copy);
    for (std::size_t s = 0; s < variants.size(); ++s) {
      const double seconds = timed([&] {
        for (int t = 0; t < steps; ++t) fluids[s]->step();
      });
      if (r > 0) step_seconds[s].push_back(seconds / steps);
    }
  }
  std::vector<double> bytes(variants.size());
  for (std::size_t s = 0; s < variants.size(); ++s) {
    const double mine = static_cast<double>(fluids[s]->bytes());
    MPI_Reduce(&mine, &bytes[s], 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  }
  if (rank != 0) return;
  const double copy_gb = ranks * 3.0 * sizeof(double) * copied / median(copy_seconds) / 1e9;
  for (std::size_t s = 0; s < variants.size(); ++s) {
    const Variant& v = variants[s];
    const double mlups = updates / median(step_seconds[s]) / 1e6;
    const double fraction = mlups * 1e6 * v.bytes_per_update() / (copy_gb * 1e9);
    if (json)
      std::printf("%s\n", nlohmann::ordered_json{{"scheme", v.scheme},
                                                 {"precision", v.precision_name()},
                                                 {"ranks", ranks},
                                                 {"grid", nodes},
                                                 {"mlups", mlups},
                                                 {"bytes_per_update", v.bytes_per_update()},
                                                 {"copy_gb_per_s", copy_gb},
                                                 {"fraction", fraction},
                                                 {"bytes_per_node", bytes[s] / updates}}
                              .dump()
                              .c_str());
    else
      std::printf("fluid %-11s %s, %d ranks, 108 x 144 x 96: %6.1f MLUPS, %3.0f bytes an update, "
                  "%.2f of the copy rate %.1f GB/s, %.0f bytes a node\n",
                  v.scheme, v.precision_name(), ranks, mlups, v.bytes_per_update(), fraction,
                  copy_gb, bytes[s] / updates);
  }
}

}  // namespace

int bench(const std::vector<std::string>& names, bool json) {
  struct Benchmark {
    const char* name;
    void (*run)(bool json);
  };
  constexpr Benchmark all[] = {{"fluid", bench_fluid},
                               {"membrane", bench_membrane},
                               {"dipole", bench_dipole},
                               {"field", bench_field}};
  for (const std::string& name : names)
    if (std::none_of(std::begin(all), std::end(all),
                     [&](const auto& b) { return name == b.name; })) {
      int rank = 0;
      MPI_Comm_rank(MPI_COMM_WORLD, &rank);
      if (rank == 0)
        std::fprintf(stderr,
                     "hemomag bench: %s is not available in this version; accepted: fluid, "
                     "membrane, dipole, field\n",
                     name.c_str());
      return 2;
    }
  for (const Benchmark& b : all)
    if (names.empty() || std::find(names.begin(), names.end(), b.name) != names.end()) b.run(json);
  return 0;
}

}  // namespace hemomag::app
