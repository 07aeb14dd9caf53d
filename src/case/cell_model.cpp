#include "case/cell_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <numeric>

#include "base/error.hpp"
#include "case/lattice_units.hpp"
#include "io/surface_file.hpp"
#include "lattice/surface_vessel.hpp"
#include "membrane/rest_shape.hpp"

namespace hemomag::case_ {
namespace {

constexpr double reference_vertices = 3286;  // for which contact energies are given
constexpr std::size_t most_vertices = 100000;
constexpr double most_cells = 1e7;  // as of cell.count

membrane::RestShape rest_shape(const Cell& cell) {
  switch (cell.kind) {
  case CellKind::platelet:
    return membrane::spheroid(cell.diameter, cell.thickness);
  case CellKind::white:
    return membrane::spheroid(cell.diameter, cell.diameter);
  default:
    return membrane::red_cell_shape(cell.diameter);
  }
}

/// The number of parts that share no vertex.
int pieces(const lattice::Surface& s) {
  std::vector<int> parent(s.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[static_cast<std::size_t>(v)] != v) {
      int& up = parent[static_cast<std::size_t>(v)];
      v = up = parent[static_cast<std::size_t>(up)];
    }
    return v;
  };
  int count = static_cast<int>(s.points.size());
  for (const auto& t : s.triangles)
    for (const int corner : {t[1], t[2]}) {
      const int a = root(t[0]), b = root(corner);
      if (a == b) continue;
      parent[static_cast<std::size_t>(a)] = b;
      --count;
    }
  return count;
}

Vec3 centre_of_volume(const lattice::Surface& s) {
  Vec3 moment;
  double volume = 0;
  const Vec3 origin = s.points[0];  // near the surface, lest far coordinates cancel
  for (const auto& t : s.triangles) {
    const Vec3 a = s.points[static_cast<std::size_t>(t[0])] - origin,
               b = s.points[static_cast<std::size_t>(t[1])] - origin,
               c = s.points[static_cast<std::size_t>(t[2])] - origin;
    const double six = dot(a, cross(b, c));
    volume += six;
    moment += (six / 4) * (a + b + c);
  }
  return origin + moment / volume;
}

void take_shape(CellModel& m, const Cell& cell, std::uint64_t seed) {
  const membrane::RestShape shape = rest_shape(cell);
  m.mesh = membrane::evened_mesh(shape, cell.vertices, seed);
  m.topology = membrane::topology(m.mesh);
  m.radius = cell.diameter / 2;
  m.reach = std::max(cell.diameter, cell.thickness) / 2;
  m.vertex_share = membrane::rest_area(shape) /
                   membrane::rest_area(membrane::red_cell_shape(cell_diameter)) *
                   (reference_vertices / cell.vertices);
  m.contains = [shape](const Vec3& p) {
    return std::fabs(p.z) < membrane::rest_height(shape, std::hypot(p.x, p.y));
  };
  if (cell.stress_free == StressFree::sphere)
    m.rest_length = membrane::stress_free_lengths(m.mesh, m.topology.edges, shape,
                                                  membrane::spheroid(1, near_sphere_aspect));
}

void take_surface(CellModel& m, const Cell& cell) {
  for (const Vec3& p : cell.surface->points) m.mesh.x.push_back(cell.mesh_unit * p);
  m.mesh.triangles = cell.surface->triangles;
  m.topology = membrane::topology(m.mesh);
  const double area = membrane::surface_area(m.mesh);
  m.radius = std::sqrt(area / (4 * std::numbers::pi));
  m.vertex_share = area / membrane::rest_area(membrane::red_cell_shape(cell_diameter)) *
                   (reference_vertices / cell.vertices);
  const auto solid = std::make_shared<const lattice::SurfaceVessel>(*cell.surface);
  m.contains = [solid, unit = cell.mesh_unit](const Vec3& p) {
    return solid->distance(p / unit) > 0;
  };
}

CellModel make_model(const Cell& cell, std::uint64_t seed) {
  CellModel m;
  if (cell.surface)
    take_surface(m, cell);
  else
    take_shape(m, cell, seed);
  m.area = membrane::surface_area(m.mesh);
  m.volume = membrane::enclosed_volume(m.mesh);
  for (const Vec3& p : m.mesh.x) m.reach = std::max(m.reach, norm(p));
  std::vector<double> length;
  for (const auto& e : m.topology.edges)
    length.push_back(
        norm(m.mesh.x[static_cast<std::size_t>(e.a)] - m.mesh.x[static_cast<std::size_t>(e.b)]));
  m.longest_edge = *std::max_element(length.begin(), length.end());
  if (m.rest_length.empty()) m.rest_length = length;
  m.longest_rest_length = *std::max_element(m.rest_length.begin(), m.rest_length.end());
  m.prestress = membrane::prestress(m.mesh, m.topology.edges, m.rest_length);
  return m;
}

/// A mesh_unit that was mistaken asks for more cells than can be counted.
void check_count(const Case& c, std::size_t entry, const CellModel& model) {
  const double count = c.cells[entry].hematocrit.value_or(0) * fluid_volume(c) / model.volume;
  if (c.cells[entry].count || count <= most_cells) return;
  char text[120];
  std::snprintf(text, sizeof text, "makes %.3g cells; accepted: at most %g, see cell.mesh_unit",
                count, most_cells);
  throw Error(position(c, entry_path("cell", entry, c.cells.size()) + ".hematocrit") + ": " + text);
}

}  // namespace

Cell standard_cell(CellKind kind) {
  Cell cell;
  cell.kind = kind;
  cell.vertices = 3286;
  if (kind == CellKind::rbc) return cell;
  cell.hematocrit.reset();
  cell.shear_modulus *= 10;
  cell.bending_modulus *= 10;
  if (kind == CellKind::platelet) {
    cell.diameter = 2.5e-6;
    cell.thickness = 1e-6;
    cell.vertices = 300;
  } else {
    cell.diameter = 10e-6;
  }
  return cell;
}

std::shared_ptr<const lattice::Surface> read_cell_surface(const std::string& path) {
  lattice::Surface s = io::read_surface(path);
  if (s.points.size() > most_vertices)
    throw Error(path + ": has " + std::to_string(s.points.size()) +
                " vertices; accepted: at most " + std::to_string(most_vertices));
  if (const int count = pieces(s); count != 1)
    throw Error(path + ": falls into " + std::to_string(count) +
                " pieces; accepted: one closed surface");
  const Vec3 centre = centre_of_volume(s);
  for (Vec3& p : s.points) p -= centre;
  return std::make_shared<const lattice::Surface>(std::move(s));
}

std::string mesh_copy(const Case& c, std::size_t entry) {
  if (c.cells[entry].mesh.empty()) return {};
  return entry_path("cell", entry, c.cells.size()) +
         std::filesystem::path(c.cells[entry].mesh).extension().string();
}

std::vector<CellModel> cell_models(const Case& c) {
  std::vector<CellModel> models;
  for (std::size_t k = 0; k < c.cells.size(); ++k) {
    try {
      models.push_back(make_model(c.cells[k], c.seed));
    } catch (const Error& e) {
      const std::string key = entry_path("cell", k, c.cells.size());
      throw Error(position(c, key + (c.cells[k].surface ? ".mesh" : ".vertices")) + ": " +
                  e.what() + "; accepted: another surface, number of vertices or seed");
    }
    check_count(c, k, models.back());
  }
  return models;
}

}  // namespace hemomag::case_
