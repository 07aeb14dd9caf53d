#include "case/pack.hpp"

#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "case/card.hpp"
#include "case/packed_file.hpp"
#include "case/run_directory.hpp"
#include "case/run_lock.hpp"
#include "io/files.hpp"

namespace hemomag::case_ {
namespace {

constexpr int done = 0, bad_input = 2, file_trouble = 4;

int refuse(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  return bad_input;
}

int trouble(const std::exception& e) {
  std::fprintf(stderr, "hemomag: %s\n", e.what());
  return file_trouble;
}

int make(const Case& c, const RunOptions& options) {
  if (!is_packed(c) || c.cells[0].placement == Placement::file)
    return refuse(position(c, "cell.placement") +
                  ": nothing is packed; accepted: \"compress\" or \"grow\"");
  System system;
  try {
    require_free(c, options);
    system.models = cell_models(c);
    const Card card = make_card(c, system.models);
    if (card.refused()) {
      std::fprintf(stderr, "%s", card.refusals().c_str());
      return bad_input;
    }
    PackedCells packed = pack_cells(c, system.models);
    system.cells = std::move(packed.cells);
    system.packing = packed.report;
    io::make_directory(options.out);
    const RunLock lock(options.out);
    write_directory(options, {{"case.toml", c.text},
                              {packed_copy, packed_data(c, system)},
                              {packing_report, packing_json(*system.packing)}});
  } catch (const FileError& e) {
    return trouble(e);
  } catch (const Error& e) {
    return refuse(e.what());
  } catch (const std::exception& e) {
    return trouble(e);
  }
  std::printf("%s\n%soutput in %s\n", c.title.c_str(), packing_text(*system.packing).c_str(),
              options.out.c_str());
  return done;
}

/// A gap in um, or nothing where none was found.
nlohmann::json in_um(double gap) {
  return std::isfinite(gap) ? nlohmann::json(gap * 1e6) : nlohmann::json();
}

}  // namespace

int pack_case(const Case& c, const RunOptions& options, MPI_Comm comm) {
  int rank = 0, code = done;
  MPI_Comm_rank(comm, &rank);
  if (rank == 0) code = make(c, options);
  MPI_Bcast(&code, 1, MPI_INT, 0, comm);
  return code;
}

std::string packing_text(const PackingReport& r) {
  char text[512];
  std::snprintf(text, sizeof text,
                "%zu cells (%s), hematocrit %.4f, %ld crossings of triangles\n"
                "smallest gap %.3g um, from walls %.3g um; area within %.2g %%, volume within "
                "%.2g %%\n",
                r.cells, r.method.c_str(), r.hematocrit, r.crossings, r.smallest_gap * 1e6,
                r.wall_gap * 1e6, r.area_change * 100, r.volume_change * 100);
  std::string all = text;
  if (r.steps > 0) {
    std::snprintf(text, sizeof text, "packed in %.1f s, %ld steps\n", r.seconds, r.steps);
    all += text;
  }
  return all;
}

std::string packing_json(const PackingReport& r) {
  return nlohmann::ordered_json{{"method", r.method},
                                {"cells", r.cells},
                                {"hematocrit", r.hematocrit},
                                {"crossings", r.crossings},
                                {"smallest_gap_um", in_um(r.smallest_gap)},
                                {"wall_gap_um", in_um(r.wall_gap)},
                                {"area_change_max", r.area_change},
                                {"volume_change_max", r.volume_change},
                                {"largest_force_pN", r.largest_force * 1e12},
                                {"steps", r.steps},
                                {"seconds", r.seconds}}
             .dump(2) +
         "\n";
}

}  // namespace hemomag::case_
