#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <mpi.h>

#include "app/bench.hpp"
#include "app/profiles.hpp"
#include "app/validation.hpp"
#include "base/simd.hpp"
#include "case/break_off.hpp"
#include "case/card.hpp"
#include "case/case_file.hpp"
#include "case/pack.hpp"
#include "case/run.hpp"
#include "lammps/host.hpp"
#include "lammps/signals.hpp"

// The command line: docs/command_line.md. Exit codes: 0 done, 1 a LAMMPS script failed, 2 bad
// input, 3 unstable, 4 file trouble, 128 + n stopped by signal n after a checkpoint.

namespace {

namespace case_ = hemomag::case_;

int rank() {
  int r = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &r);
  return r;
}

/// Every rank reads the case; all fail alike, one speaks.
template <class Use>
int with_case(const std::string& path, const std::vector<std::string>& overrides, Use use) {
  try {
    return use(case_::read_case(path, overrides));
  } catch (const hemomag::Error& e) {
    if (rank() == 0) std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
}

/// HEMOMAG_SIMD, before anything needs it.
bool environment_is_good() {
  try {
    hemomag::simd_level();
    return true;
  } catch (const hemomag::Error& e) {
    if (rank() == 0) std::fprintf(stderr, "%s\n", e.what());
    return false;
  }
}

int check(const case_::Case& c) {
  const auto card = case_::make_card(c, case_::cell_models(c));
  if (rank() == 0) std::printf("%s\n%s", c.title.c_str(), card.print().c_str());
  return card.refused() ? 2 : 0;
}

int lmp(const std::vector<std::string>& arguments) {
  hemomag::lammps::Host host(arguments, MPI_COMM_WORLD);
  host.script();
  // A run that a signal stopped after a checkpoint ends as the shell expects.
  return hemomag::lammps::stopped_by() ? 128 + hemomag::lammps::stopped_by() : 0;
}

int not_available(const char* what) {
  if (rank() == 0)
    std::fprintf(stderr,
                 "hemomag: %s is not available in this version; accepted: run, check, pack, lmp, "
                 "profiles, validate, bench\n",
                 what);
  return 2;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"Magnetic drug carriers among deformable red cells in flowing plasma."};
  app.set_version_flag("--version", "hemomag " HEMOMAG_VERSION);
  app.require_subcommand(1);

  std::string path, out;
  std::vector<std::string> overrides;
  bool force = false, resume = false;
  auto* run = app.add_subcommand("run", "run a case");
  auto* card =
      app.add_subcommand("check", "print the unit and stability card of a case; runs nothing");
  auto* pack = app.add_subcommand("pack", "pack the cells of a case and keep them");
  for (auto* command : {run, card, pack}) {
    command->add_option("CASE", path, "case file")->required();
    command->add_option("--set", overrides, "override a key: key.path=value")
        ->expected(1)
        ->take_all();
  }
  for (auto* command : {run, pack}) {
    command->add_option("--out", out, "directory of the output (default: out/NAME)");
    command->add_flag("--force", force, "replace an existing one");
  }
  run->add_flag("--resume", resume, "go on from the last checkpoint of the run directory");
  app.add_subcommand("lmp", "LAMMPS with the hemo styles: hemomag lmp -in FILE")->prefix_command();
  const std::vector<std::pair<const char*, const char*>> later = {
      {"sweep", "one run per value of a key"}, {"report", "one page of a finished run"}};
  std::vector<std::string> names;
  bool json = false;
  auto* validation =
      app.add_subcommand("validate", "compare with theory; all validations, or the named ones");
  validation->add_option("NAME", names, "validations to run");
  std::string figures = "out/validate";
  validation->add_option("--out", figures, "directory of figures and their data");
  auto* speed = app.add_subcommand("bench", "measure speed: fluid, membrane, dipole, field");
  speed->add_option("NAME", names, "benchmarks to run");
  for (auto* command : {validation, speed})
    command->add_flag("--json", json, "one JSON object a line");
  double from = 0;
  auto* across = app.add_subcommand(
      "profiles", "hematocrit, velocity and cell-free layer of a run from its 3-D snapshots");
  across->add_option("DIR", path, "run directory")->required();
  across->add_option("--from", from, "time in seconds at which the average begins");
  for (const auto& [name, help] : later)
    app.add_subcommand(name, std::string(help) + " (not in this version)")->prefix_command();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (rank() != 0) return e.get_exit_code() == 0 ? 0 : 2;
    return app.exit(e) == 0 ? 0 : 2;
  }
  for (const auto& [name, help] : later)
    if (app.got_subcommand(name)) return not_available(name);
  if (resume && force) {
    if (rank() == 0)
      std::fprintf(stderr,
                   "--resume: goes on with a run, which --force would remove; accepted: one "
                   "of them\n");
    return 2;
  }
  if (app.got_subcommand("validate")) return hemomag::app::validate(names, json, figures);
  if (app.got_subcommand("bench")) return hemomag::app::bench(names, json);
  if (app.got_subcommand("check")) return with_case(path, overrides, check);
  if (app.got_subcommand("profiles")) return hemomag::app::profiles(path, from);
  if (out.empty()) out = "out/" + std::filesystem::path(path).stem().string();
  return with_case(path, overrides, [&](const case_::Case& c) {
    if (app.got_subcommand("pack")) return case_::pack_case(c, {out, force}, MPI_COMM_WORLD);
    return case_::run_case(c, {out, force, resume}, MPI_COMM_WORLD);
  });
}

}  // namespace

/// MPI's profiling interface lets a program see its own calls: the one by which LAMMPS ends a run
/// in which a single rank met an error gets this program's exit code.
extern "C" int MPI_Abort(MPI_Comm comm, int) { return PMPI_Abort(comm, case_::code_of_abort()); }

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int code = 0;
  try {
    // LAMMPS has options of its own: they go through untouched.
    code = !environment_is_good()                      ? 2
           : argc > 1 && std::string(argv[1]) == "lmp" ? lmp({argv + 2, argv + argc})
                                                       : parse_and_run(argc, argv);
  } catch (const std::exception& e) {
    // What no subcommand foresaw, no memory left for one. Others may wait for this rank: all end.
    std::fprintf(stderr, "hemomag: %s\n", e.what());
    PMPI_Abort(MPI_COMM_WORLD, 4);
  }
  MPI_Finalize();
  return code;
}
