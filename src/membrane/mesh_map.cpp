#include "membrane/mesh_map.hpp"

#include "lattice/triangle_distance.hpp"
#include "membrane/area_volume.hpp"

namespace hemomag::membrane {
namespace {

lattice::Triangle corners(std::span<const Vec3> x, const std::array<int, 3>& t) {
  return {x[static_cast<std::size_t>(t[0])], x[static_cast<std::size_t>(t[1])],
          x[static_cast<std::size_t>(t[2])]};
}

/// Sums of the normals of the triangles at each vertex, weighted with their areas.
std::vector<Vec3> vertex_normals(std::span<const Vec3> x,
                                 std::span<const std::array<int, 3>> triangles) {
  std::vector<Vec3> normals(x.size());
  for (const auto& t : triangles) {
    const auto c = corners(x, t);
    for (const int v : t)
      normals[static_cast<std::size_t>(v)] += twice_area_vector(c[0], c[1], c[2]);
  }
  for (Vec3& n : normals) n = n / norm(n);
  return normals;
}

/// Three unit vectors at right angles.
struct Frame {
  Vec3 along, across, normal;
};

Frame frame(const lattice::Triangle& t, const lattice::Triangle& normals,
            const std::array<double, 3>& w) {
  Frame f;
  f.normal = w[0] * normals[0] + w[1] * normals[1] + w[2] * normals[2];
  f.normal = f.normal / norm(f.normal);
  const Vec3 edge = t[1] - t[0];
  f.along = edge - dot(edge, f.normal) * f.normal;
  f.along = f.along / norm(f.along);
  f.across = cross(f.normal, f.along);
  return f;
}

Vec3 at(const lattice::Triangle& t, const std::array<double, 3>& w) {
  return w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
}

}  // namespace

MeshMap::MeshMap(const TriangleMesh& coarse, const TriangleMesh& fine)
    : triangles_(coarse.triangles) {
  const auto normals = vertex_normals(coarse.x, triangles_);
  for (const Vec3& p : fine.x) {
    Place place{0, {}, {}};
    double least = -1;
    for (std::size_t k = 0; k < triangles_.size(); ++k) {
      const auto foot = lattice::nearest_point(p, corners(coarse.x, triangles_[k]));
      const double d2 = norm2(p - foot.x);
      if (least >= 0 && d2 >= least) continue;
      least = d2;
      place.triangle = k;
      place.weight = foot.weight;
    }
    const auto& t = triangles_[place.triangle];
    const auto c = corners(coarse.x, t);
    const Frame f = frame(c, corners(normals, t), place.weight);
    const Vec3 r = p - at(c, place.weight);
    place.offset = {dot(r, f.along), dot(r, f.across), dot(r, f.normal)};
    places_.push_back(place);
  }
}

std::vector<Vec3> MeshMap::operator()(std::span<const Vec3> x) const {
  const auto normals = vertex_normals(x, triangles_);
  std::vector<Vec3> fine;
  fine.reserve(places_.size());
  for (const Place& p : places_) {
    const auto& t = triangles_[p.triangle];
    const auto c = corners(x, t);
    const Frame f = frame(c, corners(normals, t), p.weight);
    fine.push_back(at(c, p.weight) + p.offset.x * f.along + p.offset.y * f.across +
                   p.offset.z * f.normal);
  }
  return fine;
}

}  // namespace hemomag::membrane
