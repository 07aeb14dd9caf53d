#include "case/run.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include <nlohmann/json.hpp>

#include "case/break_off.hpp"
#include "case/card.hpp"
#include "case/cells_data.hpp"
#include "case/external_field.hpp"
#include "case/lattice_units.hpp"
#include "case/measured_layer.hpp"
#include "case/pack.hpp"
#include "case/packed_file.hpp"
#include "case/profile_summary.hpp"
#include "case/script.hpp"
#include "io/files.hpp"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_series.h"
#include "lammps/fix_hemo_watch.h"
#include "lammps/host.hpp"

namespace hemomag::case_ {
namespace {

constexpr int done = 0, bad_input = 2, file_trouble = 4;

/// What rank 0 decided, told to all.
int agree(int code, MPI_Comm comm) {
  MPI_Bcast(&code, 1, MPI_INT, 0, comm);
  return code;
}

int fail(const std::string& message, int code) {
  std::fprintf(stderr, "hemomag: %s\n", message.c_str());
  return code;
}

/// The files of a run directory before it runs: name and content.
using Files = std::map<std::string, std::string>;

std::string whole_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw Error(path + ": cannot be read");
  return content;
}

/// Meshes and starting states of cells that the case refers to.
void add_cell_copies(const Case& c, Files& files) {
  if (!c.cells.empty() && c.cells[0].placement == Placement::file)
    files[packed_copy] = whole_file(c.cells[0].packed);
  for (std::size_t k = 0; k < c.cells.size(); ++k)
    if (const std::string copy = mesh_copy(c, k); !copy.empty())
      files[copy] = whole_file(c.cells[k].mesh);
}

/// The card and the starting state; nothing is written. Rank 0 only.
int prepare(const Case& c, const RunOptions& options, Files& files, System& system) {
  const auto models = cell_models(c);
  const Card card = make_card(c, models);
  if (card.refused()) {
    std::fprintf(stderr, "%s", card.refusals().c_str());
    return bad_input;
  }
  if (std::filesystem::exists(options.out) && !options.force)
    return fail("--out " + options.out +
                    ": exists already; accepted: another directory, or --force to replace it",
                bad_input);
  system = place(c);
  if (system.packing) {
    std::printf("%s", packing_text(*system.packing).c_str());
    files["pack.json"] = packing_json(*system.packing);
  }
  files["case.toml"] = c.text;
  files["cells.data"] = cells_data(c, system);
  files["in.lammps"] = lammps_script(c, system);
  if (const std::string copy = geometry_copy(c); !copy.empty())
    files[copy] = whole_file(c.channel.geometry);
  add_cell_copies(c, files);
  for (const MagneticSource& s : c.magnetic.sources)
    if (s.table) files[table_copy(s)] = whole_file(s.file);
  return done;
}

void write_directory(const std::string& out, const Files& files) {
  std::filesystem::remove_all(out);
  io::make_directory(out);
  for (const auto& [name, content] : files) io::replace_file(out + "/" + name, content);
}

/// Run the script of the directory, with a progress line before its `run`.
void execute(lammps::Host& host, const std::string& path, double dt) {
  std::ifstream script(path);
  if (!script) throw Error(path + ": cannot be read");
  for (std::string line; std::getline(script, line);) {
    if (line.rfind("run ", 0) == 0)
      host.command("fix progress all hemo/progress dt_s " + std::to_string(dt * 1e6) + "e-6");
    host.command(line);
  }
}

nlohmann::json summary(const Case& c, lammps::Host& host, double wall_s) {
  const LatticeUnits units = lattice_units(c);
  const auto* series = lammps::find_fix<LAMMPS_NS::FixHemoSeries>(&host.lammps(), "hemo/series");
  const auto* watch = lammps::find_fix<LAMMPS_NS::FixHemoWatch>(&host.lammps(), "hemo/watch");
  const auto& seen = watch->record();
  const double fluid_nodes = fluid_volume(c) / std::pow(units.dx, 3);
  const double updates = fluid_nodes * static_cast<double>(steps(c));
  nlohmann::json s = {
      {"title", c.title},
      {"steps", steps(c)},
      {"dt_s", units.dt},
      {"dx_m", units.dx},
      {"wall_s", wall_s},
      {"mlups", updates / wall_s / 1e6},
      {"probability_end", series ? nlohmann::json(series->probability_end()) : nlohmann::json()},
      {"probability_mean", series ? nlohmann::json(series->probability_mean()) : nlohmann::json()},
      {"cells_start", seen.cells_start},
      {"cells_end", seen.cells_end},
      {"carriers_start", seen.carriers_start},
      {"carriers_end", seen.carriers_end},
      {"carriers_inside_max", seen.carriers_inside_max},
      {"mach_max", seen.mach_max},
      {"area_drift_max", seen.area_drift_max},
      {"volume_drift_max", seen.volume_drift_max}};
  add_profiles(s, c, host);
  return s;
}

void print_summary(const nlohmann::json& s, const std::string& out) {
  std::printf("%ld steps in %.1f s\n", s["steps"].get<long>(), s["wall_s"].get<double>());
  if (!s["probability_end"].is_null())
    std::printf("margination probability %.3f at the end, %.3f in the mean\n",
                s["probability_end"].get<double>(), s["probability_mean"].get<double>());
  if (s["carriers_inside_max"].get<long>() > 0)
    std::printf("warning: up to %ld carriers were inside cells at one time\n",
                s["carriers_inside_max"].get<long>());
  std::printf("output in %s\n", out.c_str());
}

/// Run the script of a directory and sum it up there. Collective.
int simulate(const Case& c, const std::string& out, MPI_Comm comm) {
  int rank = 0, code = done;
  MPI_Comm_rank(comm, &rank);
  // From here on LAMMPS itself ends the process when something goes wrong (break_off.hpp).
  const auto home = std::filesystem::current_path();
  std::filesystem::current_path(out);
  try {
    const RunInProgress running(rank);
    lammps::Host host({"-screen", "none", "-log", "log.lammps"}, comm);
    const double start = MPI_Wtime();
    execute(host, "in.lammps", lattice_units(c).dt);
    const double wall_s = MPI_Wtime() - start;
    const auto results = summary(c, host, wall_s);
    if (rank == 0) {
      io::replace_file("summary.json", results.dump(2) + "\n");
      print_summary(results, out);
    }
  } catch (const std::exception& e) {
    code = rank == 0 ? fail(e.what(), file_trouble) : file_trouble;
  }
  std::filesystem::current_path(home);
  return code;
}

/// Run the cells alone in DIR/layer, and give the main script the layer that they leave free.
/// Collective.
int measure_layer(Case c, System system, const std::string& out, MPI_Comm comm) {
  int rank = 0, code = done;
  MPI_Comm_rank(comm, &rank);
  const Case alone = cells_alone(c);
  if (rank == 0) {
    try {
      System cells = system;
      cells.carriers.clear();
      Files files{{"case.toml", alone.text},
                  {"cells.data", cells_data(alone, cells)},
                  {"in.lammps", lammps_script(alone, cells)}};
      add_cell_copies(alone, files);
      write_directory(out + "/layer", files);
    } catch (const std::exception& e) {
      code = fail(e.what(), file_trouble);
    }
  }
  code = agree(code, comm);
  if (code == done) code = simulate(alone, out + "/layer", comm);
  if (rank == 0 && code == done) {
    try {
      c.analysis.layer = layer_of(out + "/layer/summary.json");
      io::replace_file(out + "/in.lammps", lammps_script(c, system));
      std::printf("cell-free layer: %.3f um\n", c.analysis.layer * 1e6);
    } catch (const std::exception& e) {
      code = fail(e.what(), file_trouble);
    }
  }
  return agree(code, comm);
}

}  // namespace

int run_case(const Case& c, const RunOptions& options, MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  int code = done;
  System system;
  if (rank == 0) {
    try {
      Files files;
      code = prepare(c, options, files, system);
      if (code == done) {
        std::printf("%s\n", c.title.c_str());
        try {
          write_directory(options.out, files);
        } catch (const std::exception& e) {
          code = fail(e.what(), file_trouble);
        }
      }
    } catch (const Error& e) {
      std::fprintf(stderr, "%s\n", e.what());
      code = bad_input;
    }
  }
  code = agree(code, comm);
  if (code != done) return code;

  if (c.analysis.measured) code = measure_layer(c, system, options.out, comm);
  return code == done ? simulate(c, options.out, comm) : code;
}

}  // namespace hemomag::case_
