#include "membrane/topology.hpp"

#include <algorithm>
#include <string>
#include <tuple>

#include "base/error.hpp"

namespace hemomag::membrane {
namespace {

/// One side of an edge: the triangle (opposite, a, b) when forward, (opposite, b, a) when not; a <
/// b.
struct Side {
  int a, b, opposite;
  bool forward;
};

std::vector<Side> sides_of(const TriangleMesh& mesh) {
  const int vertices = static_cast<int>(mesh.x.size());
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const auto [low, high] = std::minmax({t[0], t[1], t[2]});
    if (low < 0 || high >= vertices || t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      throw Error("mesh: triangle (" + std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " +
                  std::to_string(t[2]) + ") needs three different vertices of 0 to " +
                  std::to_string(vertices - 1));
    for (int j = 0; j < 3; ++j) {
      const int from = t[j], to = t[(j + 1) % 3], opposite = t[(j + 2) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), opposite, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) {
    return std::tuple(p.a, p.b, !p.forward, p.opposite) <
           std::tuple(q.a, q.b, !q.forward, q.opposite);
  });
  return sides;
}

[[noreturn]] void refuse(const Side& side, const std::string& why) {
  throw Error("mesh: edge " + std::to_string(side.a) + "-" + std::to_string(side.b) + " " + why);
}

}  // namespace

Topology topology(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw Error("mesh: no triangles, need a closed surface");
  const std::vector<Side> sides = sides_of(mesh);
  Topology result;
  result.edges.reserve(sides.size() / 2);
  result.hinges.reserve(sides.size() / 2);
  for (std::size_t i = 0; i < sides.size();) {
    const Side& left = sides[i];
    std::size_t end = i;
    while (end < sides.size() && sides[end].a == left.a && sides[end].b == left.b) ++end;
    if (end - i == 1) refuse(left, "belongs to one triangle only: the surface is open");
    if (end - i > 2)
      refuse(left, "belongs to " + std::to_string(end - i) + " triangles: the surface branches");
    const Side& right = sides[i + 1];
    if (left.forward == right.forward)
      refuse(left, "runs the same way in both its triangles: their orientations differ");
    result.edges.push_back({left.a, left.b});
    result.hinges.push_back({left.opposite, left.a, left.b, right.opposite});
    i = end;
  }
  return result;
}

}  // namespace hemomag::membrane
