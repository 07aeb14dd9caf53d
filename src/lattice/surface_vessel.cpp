#include "lattice/surface_vessel.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "lattice/closed_surface.hpp"

namespace hemomag::lattice {
namespace {

constexpr std::size_t leaf_size = 4;
constexpr int face_feature = 6;

// Halving the triangles at each level, 2^31 of them need 31 levels; each leaves one node waiting.
constexpr std::size_t stack_size = 64;

double distance2(const Vec3& low, const Vec3& high, const Vec3& x) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double outside = std::max({low[d] - x[d], x[d] - high[d], 0.0});
    sum += outside * outside;
  }
  return sum;
}

/// Of corner k of a triangle.
double angle(const std::array<Vec3, 3>& corner, std::size_t k) {
  const Vec3 u = corner[(k + 1) % 3] - corner[k];
  const Vec3 v = corner[(k + 2) % 3] - corner[k];
  return std::atan2(norm(cross(u, v)), dot(u, v));
}

}  // namespace

SurfaceVessel::SurfaceVessel(Surface surface) : surface_(closed(std::move(surface), "vessel")) {
  const auto n = surface_.triangles.size();
  nodes_.reserve(2 * n / leaf_size + 2);
  build_tree(0, n);
  faces_.reserve(n);
  for (const auto& t : surface_.triangles) {
    Face face;
    for (std::size_t k = 0; k < 3; ++k)
      face.corner[k] = surface_.points[static_cast<std::size_t>(t[k])];
    const auto& [a, b, c] = face.corner;
    face.normal = cross(b - a, c - a);
    face.normal *= 1 / norm(face.normal);
    for (std::size_t k = 0; k < 3; ++k)
      face.inward[k] = cross(face.normal, face.corner[(k + 1) % 3] - face.corner[k]);
    faces_.push_back(face);
  }
  set_pseudonormals();
}

/// Splits triangles [first, last) at the median of their middles along the longest side of the
/// middles' box.
void SurfaceVessel::build_tree(std::size_t first, std::size_t last) {
  auto& triangles = surface_.triangles;
  const auto corner = [&](const std::array<int, 3>& t, std::size_t k) {
    return surface_.points[static_cast<std::size_t>(t[k])];
  };
  const auto middle = [&](const std::array<int, 3>& t) {  // times three
    return corner(t, 0) + corner(t, 1) + corner(t, 2);
  };
  constexpr double far = std::numeric_limits<double>::infinity();
  Node node{{far, far, far}, {-far, -far, -far}, 0, 0, 0};
  Vec3 low = node.low, high = node.high;
  for (std::size_t i = first; i < last; ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      for (std::size_t k = 0; k < 3; ++k) {
        node.low[d] = std::min(node.low[d], corner(triangles[i], k)[d]);
        node.high[d] = std::max(node.high[d], corner(triangles[i], k)[d]);
      }
      low[d] = std::min(low[d], middle(triangles[i])[d]);
      high[d] = std::max(high[d], middle(triangles[i])[d]);
    }
  const auto mine = nodes_.size();
  if (last - first <= leaf_size) {
    node.first = static_cast<std::uint32_t>(first);
    node.count = static_cast<std::uint32_t>(last - first);
    nodes_.push_back(node);
    return;
  }
  nodes_.push_back(node);
  const Vec3 side = high - low;
  const std::size_t d = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
  const auto half = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return triangles.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(half), at(last),
                   [&](const auto& s, const auto& t) { return middle(s)[d] < middle(t)[d]; });
  build_tree(first, half);
  nodes_[mine].second = static_cast<std::uint32_t>(nodes_.size());
  build_tree(half, last);
}

void SurfaceVessel::set_pseudonormals() {
  const auto& triangles = surface_.triangles;
  const auto directed = [](int a, int b) {
    return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
  };
  std::unordered_map<std::uint64_t, std::size_t> face_on;
  face_on.reserve(3 * triangles.size());
  vertex_normals_.assign(surface_.points.size(), {});
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      face_on[directed(triangles[t][k], triangles[t][(k + 1) % 3])] = t;
      vertex_normals_[static_cast<std::size_t>(triangles[t][k])] +=
          angle(faces_[t].corner, k) * faces_[t].normal;
    }
  edge_normals_.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      edge_normals_[t][k] =
          faces_[t].normal +
          faces_[face_on.at(directed(triangles[t][(k + 1) % 3], triangles[t][k]))].normal;
}

/// Takes the point of the face nearest to x if it is nearer than what is known. A point whose foot
/// lies outside the triangle is nearest to one of the edges beyond which it lies.
void SurfaceVessel::approach(std::size_t f, const Vec3& x, Nearest& nearest) const {
  const Face& face = faces_[f];
  bool above = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 r = x - face.corner[k];
    if (dot(face.inward[k], r) >= 0) continue;
    above = false;
    const Vec3 edge = face.corner[(k + 1) % 3] - face.corner[k];
    const double along = dot(r, edge), length2 = norm2(edge);
    int feature = static_cast<int>(k);
    Vec3 offset = r - (along / length2) * edge;
    if (along <= 0) {
      feature = 3 + static_cast<int>(k);
      offset = r;
    } else if (along >= length2) {
      feature = 3 + static_cast<int>((k + 1) % 3);
      offset = x - face.corner[(k + 1) % 3];
    }
    if (const double d2 = norm2(offset); d2 < nearest.distance2) nearest = {d2, offset, f, feature};
  }
  if (!above) return;
  const double height = dot(face.normal, x - face.corner[0]);
  if (height * height < nearest.distance2)
    nearest = {height * height, height * face.normal, f, face_feature};
}

const Vec3& SurfaceVessel::pseudonormal(const Nearest& nearest) const {
  if (nearest.feature == face_feature) return faces_[nearest.face].normal;
  if (nearest.feature < 3)
    return edge_normals_[nearest.face][static_cast<std::size_t>(nearest.feature)];
  const auto corner = static_cast<std::size_t>(nearest.feature - 3);
  return vertex_normals_[static_cast<std::size_t>(surface_.triangles[nearest.face][corner])];
}

double SurfaceVessel::distance(const Vec3& x) const {
  struct Waiting {
    std::uint32_t node;
    double distance2;
  };
  std::array<Waiting, stack_size> stack;
  std::size_t waiting = 0;
  Nearest nearest{std::numeric_limits<double>::infinity(), {}, 0, face_feature};
  const auto box_distance2 = [&](std::uint32_t i) {
    return distance2(nodes_[i].low, nodes_[i].high, x);
  };
  stack[waiting++] = {0, 0};
  while (waiting > 0) {
    const auto [i, d2] = stack[--waiting];
    if (d2 >= nearest.distance2) continue;
    const Node& node = nodes_[i];
    if (node.count > 0) {
      for (std::size_t f = node.first; f < node.first + node.count; ++f) approach(f, x, nearest);
      continue;
    }
    Waiting near{i + 1, box_distance2(i + 1)};
    Waiting far{node.second, box_distance2(node.second)};
    if (far.distance2 < near.distance2) std::swap(near, far);
    stack[waiting++] = far;
    stack[waiting++] = near;
  }
  const double side = dot(nearest.offset, pseudonormal(nearest));
  return side > 0 ? -std::sqrt(nearest.distance2) : std::sqrt(nearest.distance2);
}

}  // namespace hemomag::lattice
