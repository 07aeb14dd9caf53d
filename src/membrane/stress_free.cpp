#include "membrane/stress_free.hpp"

#include <algorithm>
#include <cmath>

namespace hemomag::membrane {
namespace {

double length(const TriangleMesh& mesh, const Edge& e) {
  return norm(mesh.x[static_cast<std::size_t>(e.a)] - mesh.x[static_cast<std::size_t>(e.b)]);
}

}  // namespace

std::vector<double> stress_free_lengths(const TriangleMesh& mesh, const std::vector<Edge>& edges,
                                        const RestShape& shape, const RestShape& reference) {
  const CosineOfAreaFraction cosine(reference);
  TriangleMesh carried{{}, mesh.triangles};
  for (const Vec3& p : mesh.x) {
    const double above = rest_area_fraction_above(shape, std::cos(meridian_angle(shape, p)));
    carried.x.push_back(rest_point(reference, std::acos(cosine(above)), std::atan2(p.y, p.x)));
  }
  const double scale = std::sqrt(surface_area(mesh) / surface_area(carried));
  std::vector<double> rest;
  rest.reserve(edges.size());
  for (const Edge& e : edges) rest.push_back(scale * length(carried, e));
  return rest;
}

Prestress prestress(const TriangleMesh& mesh, const std::vector<Edge>& edges,
                    const std::vector<double>& rest_length) {
  Prestress p;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const double ratio = length(mesh, edges[e]) / rest_length[e];
    p.mean += std::fabs(ratio - 1) / static_cast<double>(edges.size());
    p.largest = std::max(p.largest, std::fabs(ratio - 1));
    p.longest = std::max(p.longest, ratio);
  }
  return p;
}

}  // namespace hemomag::membrane
