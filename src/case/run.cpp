#include "case/run.hpp"

#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include <nlohmann/json.hpp>

#include "case/break_off.hpp"
#include "case/bricks.hpp"
#include "case/card.hpp"
#include "case/case_file.hpp"
#include "case/cells_data.hpp"
#include "case/lattice_units.hpp"
#include "case/measured_layer.hpp"
#include "case/pack.hpp"
#include "case/profile_summary.hpp"
#include "case/run_directory.hpp"
#include "case/run_lock.hpp"
#include "case/same_case.hpp"
#include "case/script.hpp"
#include "io/checkpoint_directory.hpp"
#include "io/files.hpp"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_checkpoint.h"
#include "lammps/fix_hemo_series.h"
#include "lammps/fix_hemo_watch.h"
#include "lammps/host.hpp"
#include "lammps/signals.hpp"

namespace hemomag::case_ {
namespace {

namespace fs = std::filesystem;

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

/// The card and the starting state; nothing is written. Rank 0 only.
int prepare(const Case& c, const RunOptions& options, Files& files, System& system) {
  const auto models = cell_models(c);
  const Card card = make_card(c, models);
  if (card.refused()) {
    std::fprintf(stderr, "%s", card.refusals().c_str());
    return bad_input;
  }
  require_free(c, options);
  system = place(c);
  if (system.packing) {
    std::printf("%s", packing_text(*system.packing).c_str());
    files[packing_report] = packing_json(*system.packing);
  }
  files["case.toml"] = c.text;
  files["cells.data"] = cells_data(c, system);
  files["in.lammps"] = saving_script(c, system);
  add_copies(c, files);
  return done;
}

/// Where a run goes on.
struct Resumption {
  std::string checkpoint;  ///< directory, seen from that of the run
  io::CheckpointRecord record;
};

/// A file of the case must be that of which the run directory keeps a copy.
void require_same_file(const Case& c, const std::string& key, const std::string& path,
                       const std::string& copy) {
  if (whole_file(path) != whole_file(copy))
    throw Error(position(c, key) + ": " + path + " differs from the run's copy " + copy +
                "; accepted with --resume: the file the run was started with");
}

/// What a run in a directory was made of must be what it goes on with. @throws Error with the key
/// that differs
void require_same_input(const Case& c, const std::string& out, const std::string& before) {
  require_same_case(c, before);
  for (const auto& file : files_of(c))
    require_same_file(c, file.key, file.path, out + "/" + file.copy);
}

/// Whether the case can go on from a checkpoint of a run directory. @throws Error with the key that
/// differs
void require_same_run(const Case& c, const std::string& out, const Resumption& from) {
  const std::string before = whole_file(out + "/" + from.checkpoint + "/case.toml");
  require_same_input(c, out, before);
  require_room_for_output(c, before, out);
  const Case was = read_case(out + "/case.toml", {});
  const double from_s = was.analysis.average_from;
  if (std::fabs(from_s - c.analysis.average_from) > 1e-9 * from_s) {  // the text is rounded
    char seconds[40];
    std::snprintf(seconds, sizeof seconds, "\"%.9g s\"", from_s);
    throw Error(position(c, "analysis.average_from") +
                ": is another time (the default moves with "
                "run.time) than that from which the run has averaged; accepted: " +
                seconds);
  }
  if (from.record.step > steps(c))
    throw Error(position(c, c.run.time ? "run.time" : "run.steps") + ": " +
                std::to_string(steps(c)) + " steps end before the checkpoint, which is of step " +
                std::to_string(from.record.step) + "; accepted: a longer run");
}

/// Run the script of the directory, with a progress line before its `run`.
void execute(lammps::Host& host, const std::string& path, double dt) {
  std::ifstream script(path);
  if (!script) throw FileError(path + ": cannot be read");
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
  const auto* checkpoint =
      lammps::find_fix<LAMMPS_NS::FixHemoCheckpoint>(&host.lammps(), "hemo/checkpoint");
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
      {"displacement_max_nodes", seen.displacement_max},
      {"stretch_max", seen.stretch_max},
      {"watch_s", seen.seconds},
      {"checkpoint_s", checkpoint ? checkpoint->seconds() : 0.0},
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

/// Rank 0's work before a run, an exit code for all: bad input is what the user can mend.
template <class Work> int agreed(MPI_Comm comm, Work work) {
  int rank = 0, code = done;
  MPI_Comm_rank(comm, &rank);
  if (rank == 0) {
    try {
      code = work();
    } catch (const FileError& e) {
      code = fail(e.what(), file_trouble);
    } catch (const Error& e) {
      std::fprintf(stderr, "%s\n", e.what());
      code = bad_input;
    } catch (const std::exception& e) {
      code = fail(e.what(), file_trouble);
    }
  }
  return agree(code, comm);
}

/// A new run directory. Rank 0 only.
int start(const Case& c, const RunOptions& options, std::unique_ptr<RunLock>& lock,
          System& system) {
  Files files;
  if (const int code = prepare(c, options, files, system); code != done) return code;
  std::printf("%s\n", c.title.c_str());
  io::make_directory(options.out);
  lock = std::make_unique<RunLock>(options.out);
  write_directory(options, files);
  return done;
}

bool has_checkpoint(const std::string& out) {
  for (const auto& entry : fs::directory_iterator(out))
    if (entry.path().stem() == checkpoint_name) return true;
  return false;
}

int nothing_to_resume(const RunOptions& options) {
  return fail("--resume: " + options.out +
                  " holds no whole checkpoint; accepted: the directory of a run that wrote one, or "
                  "a new run with --force",
              bad_input);
}

/// The last whole checkpoint of the run directory, found by all ranks.
int find(const RunOptions& options, MPI_Comm comm, Resumption& from) {
  try {
    const std::string directory = options.out + "/" + checkpoint_name;
    const auto found = io::find_checkpoint(comm, directory);
    return agreed(comm, [&] {
      for (const auto& reason : found.refused)
        std::fprintf(stderr, "hemomag: not used: %s\n", reason.c_str());
      if (found.directory.empty()) return nothing_to_resume(options);
      from = {io::name_of(found.directory), found.record};
      return done;
    });
  } catch (const FileError& e) {
    return agreed(comm, [&] { return fail(e.what(), file_trouble); });
  }
}

/// Make a run directory ready to go on. Rank 0 only.
int go_on(Case c, const RunOptions& options, const Resumption& from) {
  require_same_run(c, options.out, from);
  if (c.analysis.measured) c.analysis.layer = layer_of(options.out + "/" + layer_summary);
  System system;
  system.models = cell_models(c);
  io::replace_file(options.out + "/case.toml", c.text);
  io::replace_file(options.out + "/resume.lammps",
                   resumed_script(c, system, from.checkpoint, from.record.wall_s));
  std::printf("%s\ngoing on from step %ld\n", c.title.c_str(), from.record.step);
  return done;
}

/// Run the script in the present directory, that of the run. @return exit code
int execute(const Case& c, const RunOptions& options, double wall_before_s, MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  lammps::Host host({"-screen", "none", "-log", "none"}, comm);
  if (rank != 0) host.keep_log();
  const double start = MPI_Wtime();
  host.command(options.resume ? "log log.lammps append" : "log log.lammps");
  execute(host, options.resume ? "resume.lammps" : "in.lammps", lattice_units(c).dt);
  if (const int signal = lammps::stopped_by(); signal != 0) {
    if (rank == 0)
      std::printf("stopped by a signal after a checkpoint; --resume goes on from it\n");
    return 128 + signal;
  }
  const auto results = summary(c, host, wall_before_s + MPI_Wtime() - start);
  if (rank == 0) {
    io::replace_file("summary.json", results.dump(2) + "\n");
    print_summary(results, options.out);
  }
  return done;
}

/// Run the script of a directory and sum it up there. Collective.
/// @param wall_before_s  that the run has taken until then
int simulate(const Case& c, const RunOptions& options, double wall_before_s, MPI_Comm comm) {
  int rank = 0, code = done;
  MPI_Comm_rank(comm, &rank);
  // From here on LAMMPS itself ends the process when something goes wrong (break_off.hpp).
  const auto home = fs::current_path();
  fs::current_path(options.out);
  try {
    const RunInProgress running(rank);
    code = execute(c, options, wall_before_s, comm);
  } catch (const Error& e) {
    code = rank == 0 ? fail(e.what(), file_trouble) : file_trouble;
  } catch (const std::exception& e) {
    // What this rank alone has met (no memory, for one): others may wait for it, and all end.
    fail("rank " + std::to_string(rank) + ": " + e.what(), file_trouble);
    PMPI_Abort(comm, file_trouble);
  }
  fs::current_path(home);
  return code;
}

/// Give the main script the layer that has been measured. Rank 0 only.
int use_layer(Case c, const System& models, const std::string& out) {
  c.analysis.layer = layer_of(out + "/" + layer_summary);
  io::replace_file(out + "/in.lammps", saving_script(c, models));
  for (const auto& entry : fs::directory_iterator(out + "/" + layer_directory))
    if (entry.path().stem() == checkpoint_name) fs::remove_all(entry.path());
  std::printf("cell-free layer: %.3f um\n", c.analysis.layer * 1e6);
  return done;
}

/// Run the cells alone in DIR/layer, and give the main script the layer that they leave free.
/// Collective.
int measure_layer(const Case& c, const System& system, const std::string& out, MPI_Comm comm) {
  const Case alone = cells_alone(c);
  const RunOptions options{out + "/" + layer_directory};
  int code = agreed(comm, [&] {
    System cells = system;
    cells.carriers.clear();
    Files files{{"case.toml", alone.text},
                {"cells.data", cells_data(alone, cells)},
                {"in.lammps", saving_script(alone, cells)}};
    add_copies(alone, files);
    io::make_directory(options.out);
    write_directory(options, files);
    return done;
  });
  if (code == done) code = simulate(alone, options, 0, comm);
  return code == done ? agreed(comm, [&] { return use_layer(c, system, out); }) : code;
}

/// A run that stopped before its first checkpoint, while its layer was measured: go on there.
/// Collective.
int finish_layer(const Case& c, const RunOptions& options, MPI_Comm comm) {
  const Case alone = cells_alone(c);
  const RunOptions layer{options.out + "/" + layer_directory, false, true};
  Resumption from;
  int code = agreed(comm, [&] {
    require_same_input(c, options.out, whole_file(options.out + "/case.toml"));
    return done;
  });
  if (code == done && !agree(fs::exists(options.out + "/" + layer_summary), comm)) {
    code = find(layer, comm, from);
    if (code == done) code = agreed(comm, [&] { return go_on(alone, layer, from); });
    if (code == done) code = simulate(alone, layer, from.record.wall_s, comm);
  }
  if (code != done) return code;
  return agreed(comm, [&] {
    System models;
    models.models = cell_models(c);
    io::replace_file(options.out + "/case.toml", c.text);
    return use_layer(c, models, options.out);
  });
}

}  // namespace

int run_case(const Case& c, const RunOptions& options, MPI_Comm comm) {
  std::signal(SIGUSR1, SIG_IGN);  // a request to save, before there is anything to be saved
  std::unique_ptr<RunLock> lock;  // rank 0's
  System system;
  Resumption from;
  const RankGrid ranks = rank_grid(c, comm);
  int code = agreed(comm, [&] {
    require_bricks(c, ranks);
    if (!options.resume) return start(c, options, lock, system);
    if (!fs::is_directory(options.out))
      return fail("--resume: there is no run directory " + options.out +
                      "; accepted: --out DIR of a run",
                  bad_input);
    if (!fs::exists(options.out + "/in.lammps")) return nothing_to_resume(options);
    lock = std::make_unique<RunLock>(options.out);
    return done;
  });
  if (code != done) return code;

  const bool layer_first =
      c.analysis.measured && (!options.resume || agree(!has_checkpoint(options.out), comm));
  if (layer_first) {
    code = options.resume ? finish_layer(c, options, comm)
                          : measure_layer(c, system, options.out, comm);
    return code == done ? simulate(c, {options.out}, 0, comm) : code;
  }
  if (options.resume) {
    code = find(options, comm, from);
    if (code == done) code = agreed(comm, [&] { return go_on(c, options, from); });
  }
  return code == done ? simulate(c, options, from.record.wall_s, comm) : code;
}

}  // namespace hemomag::case_
