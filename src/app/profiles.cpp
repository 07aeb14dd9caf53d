#include "app/profiles.hpp"

#include <cstdio>
#include <filesystem>
#include <vector>

#include <mpi.h>

#include "analysis/cell_free_layer.hpp"
#include "analysis/profiles.hpp"
#include "base/error.hpp"
#include "io/files.hpp"
#include "io/read_vtkhdf.hpp"

namespace hemomag::app {
namespace {

using analysis::SurfaceTriangle;

/// Values of one snapshot: hematocrit and velocity [mm/s] of every slab, then the layer at the
/// lower and upper plate and the same as seen along x [um].
enum Tail { layer, seen = layer + 2, tail = seen + 2 };

std::vector<SurfaceTriangle> surface_of(const io::TriangleGrid& grid) {
  std::vector<SurfaceTriangle> surface;
  for (const auto& t : grid.triangles) {
    SurfaceTriangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.x[k] = grid.points[static_cast<std::size_t>(t[k])];
      triangle.tag[k] = t[k];
    }
    surface.push_back(triangle);
  }
  return surface;
}

std::vector<double> measure(const io::VectorImage& flow, const io::TriangleGrid& grid) {
  const auto slabs = static_cast<std::size_t>(flow.nodes[2]);
  const std::size_t plane = flow.values.size() / slabs;
  const Vec3 channel{flow.nodes[0] * flow.spacing, flow.nodes[1] * flow.spacing,
                     flow.nodes[2] * flow.spacing};
  std::vector<double> values(2 * slabs + tail, 0.0);
  const auto surface = surface_of(grid);
  const std::span<double> hematocrit(values.data(), slabs);
  analysis::add_enclosed_volume(surface, flow.spacing, hematocrit);
  for (double& ht : hematocrit) ht /= channel.x * channel.y * flow.spacing;
  for (std::size_t k = 0; k < flow.values.size(); ++k)
    values[slabs + k / plane] += 1e3 * flow.values[k].y / static_cast<double>(plane);
  analysis::FacingSurfaces facing(channel, flow.spacing / 2);
  facing.add(surface);
  for (std::size_t side = 0; side < 2; ++side) {
    const auto free = facing.layer(static_cast<int>(side));
    values[2 * slabs + layer + side] = free.mean;
    values[2 * slabs + seen + side] = free.seen;
  }
  return values;
}

void write_profiles(const std::string& path, const analysis::Moments& m, std::size_t slabs,
                    double spacing) {
  io::CsvFile csv(path, "z_um,hematocrit,hematocrit_sd,velocity_mm_per_s,velocity_sd_mm_per_s");
  for (std::size_t k = 0; k < slabs; ++k)
    csv.row({(static_cast<double>(k) + 0.5) * spacing, m.mean(k), m.deviation(k), m.mean(slabs + k),
             m.deviation(slabs + k)});
}

void print(const analysis::Moments& m, std::size_t slabs) {
  const auto line = [&](const char* what, std::size_t k) {
    std::printf("%-34s %8.3f +- %.3f um\n", what, m.mean(k), m.deviation(k));
  };
  std::printf("%ld snapshots\n", m.count());
  line("cell-free layer, lower plate", 2 * slabs + layer);
  line("cell-free layer, upper plate", 2 * slabs + layer + 1);
  line("as seen along x, lower plate", 2 * slabs + seen);
  line("as seen along x, upper plate", 2 * slabs + seen + 1);
}

int work(const std::string& directory, double from) {
  const std::string fields = directory + "/fields/";
  for (const char* index : {"fluid.vtkhdf.series", "cells.vtkhdf.series"})
    if (!std::filesystem::exists(fields + index)) {
      std::fprintf(stderr,
                   "hemomag: %s%s: is missing; a run directory with 3-D snapshots of fluid and "
                   "cells is expected\n",
                   fields.c_str(), index);
      return 2;
    }
  const auto flow = io::read_series(fields + "fluid.vtkhdf.series");
  const auto cells = io::read_series(fields + "cells.vtkhdf.series");
  analysis::Moments m;
  std::size_t slabs = 0;
  double spacing = 0;
  io::CsvFile csv(directory + "/layer_of_fields.csv",
                  "time_s,layer_lower_um,layer_upper_um,seen_lower_um,seen_upper_um");
  for (std::size_t k = 0; k < flow.size() && k < cells.size(); ++k) {
    const auto image = io::read_image(fields + flow[k].file, "velocity_m_per_s");
    const auto values = measure(image, io::read_triangles(fields + cells[k].file));
    slabs = static_cast<std::size_t>(image.nodes[2]);
    spacing = image.spacing;
    if (flow[k].time_s >= from) m.add(values);
    std::vector<double> row{flow[k].time_s};
    row.insert(row.end(), values.end() - tail, values.end());
    csv.row(row);
  }
  if (m.count() == 0) {
    std::fprintf(stderr, "hemomag: --from %g: no snapshot is as late; accepted: at most %g s\n",
                 from, flow.empty() ? 0.0 : flow.back().time_s);
    return 2;
  }
  write_profiles(directory + "/profiles_of_fields.csv", m, slabs, spacing);
  print(m, slabs);
  return 0;
}

}  // namespace

int profiles(const std::string& directory, double from) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) return 0;
  try {
    return work(directory, from);
  } catch (const Error& e) {
    std::fprintf(stderr, "hemomag: %s\n", e.what());
    return 4;
  }
}

}  // namespace hemomag::app
