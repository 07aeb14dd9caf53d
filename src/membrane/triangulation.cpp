#include "membrane/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/error.hpp"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace hemomag::membrane {
namespace {

/// The angle at `corner` between the directions to `p` and `q`.
double angle(const Vec3& corner, const Vec3& p, const Vec3& q) {
  const Vec3 u = p - corner, v = q - corner;
  return std::atan2(norm(cross(u, v)), dot(u, v));
}

Vec3 normal(const Vec3& a, const Vec3& b, const Vec3& c) { return cross(b - a, c - a); }

}  // namespace

Triangulation::Triangulation(int vertices, std::vector<std::array<int, 3>> triangles)
    : triangles_(std::move(triangles)), across_(triangles_.size()), valences_(vertices, 0) {
  struct Half {
    int from, to, triangle, j;
    bool operator<(const Half& o) const { return std::pair(from, to) < std::pair(o.from, o.to); }
  };
  std::vector<Half> halves;
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
    for (int j = 0; j < 3; ++j) {
      halves.push_back({triangles_[t][(j + 1) % 3], triangles_[t][(j + 2) % 3], t, j});
      ++valences_[triangles_[t][j]];
    }
  std::sort(halves.begin(), halves.end());
  for (const Half& h : halves) {
    const auto twin = std::lower_bound(halves.begin(), halves.end(), Half{h.to, h.from, 0, 0});
    if (twin == halves.end() || twin->from != h.to || twin->to != h.from)
      throw Error("mesh: edge " + std::to_string(h.from) + "-" + std::to_string(h.to) +
                  " is open: the triangulation does not close");
    across_[h.triangle][h.j] = twin->triangle;
  }
}

Triangulation::Quad Triangulation::quad(int triangle, int j) const {
  const auto& t = triangles_[triangle];
  const int right = across_[triangle][j];
  const auto& back = across_[right];
  const int k = static_cast<int>(std::find(back.begin(), back.end(), triangle) - back.begin());
  return {t[j], t[(j + 1) % 3], t[(j + 2) % 3], triangles_[right][k], triangle, right, j, k};
}

/// Whether a and d share an edge: walk round a, starting from a triangle that has it.
bool Triangulation::joined(int a, int d, int triangle) const {
  int t = triangle;
  do {
    const auto& v = triangles_[t];
    const int j = static_cast<int>(std::find(v.begin(), v.end(), a) - v.begin());
    if (v[(j + 1) % 3] == d) return true;
    t = across_[t][(j + 1) % 3];
  } while (t != triangle);
  return false;
}

void Triangulation::flip(const Quad& q) {
  const int outer_ca = across_[q.left][(q.j + 1) % 3], outer_ab = across_[q.left][(q.j + 2) % 3];
  const int outer_bd = across_[q.right][(q.k + 1) % 3], outer_dc = across_[q.right][(q.k + 2) % 3];
  triangles_[q.left] = {q.a, q.b, q.d};
  across_[q.left] = {outer_bd, q.right, outer_ab};
  triangles_[q.right] = {q.d, q.c, q.a};
  across_[q.right] = {outer_ca, q.left, outer_dc};
  std::replace(across_[outer_bd].begin(), across_[outer_bd].end(), q.right, q.left);
  std::replace(across_[outer_ca].begin(), across_[outer_ca].end(), q.left, q.right);
  --valences_[q.b], --valences_[q.c], ++valences_[q.a], ++valences_[q.d];
}

int Triangulation::flip_to_delaunay(std::span<const Vec3> x) {
  constexpr double slack = 1e-9;  // co-circular quads stay as they are
  int flips = 0;
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
    for (int j = 0; j < 3; ++j) {
      const Quad q = quad(t, j);
      if (q.left > q.right) continue;
      const double sum = angle(x[q.a], x[q.b], x[q.c]) + angle(x[q.d], x[q.b], x[q.c]);
      if (sum < std::numbers::pi + slack || joined(q.a, q.d, t)) continue;
      flip(q);
      ++flips;
    }
  return flips;
}

int Triangulation::flip_to_even_valences(std::span<const Vec3> x) {
  constexpr double slack = 1e-9;
  const auto power4 = [](int v) { return (v - 6) * (v - 6) * (v - 6) * (v - 6); };
  const auto excess = [&](int b, int c, int a, int d) {
    return power4(b) + power4(c) + power4(a) + power4(d);
  };
  int flips = 0;
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
    for (int j = 0; j < 3; ++j) {
      const Quad q = quad(t, j);
      if (q.left > q.right) continue;
      const auto& v = valences_;
      const int change = excess(v[q.b] - 1, v[q.c] - 1, v[q.a] + 1, v[q.d] + 1) -
                         excess(v[q.b], v[q.c], v[q.a], v[q.d]);
      if (change > 0) continue;
      const double sum = angle(x[q.a], x[q.b], x[q.c]) + angle(x[q.d], x[q.b], x[q.c]);
      if (change == 0 && sum < std::numbers::pi + slack) continue;
      const Vec3 up = normal(x[q.a], x[q.b], x[q.c]) + normal(x[q.d], x[q.c], x[q.b]);
      if (dot(normal(x[q.a], x[q.b], x[q.d]), up) <= 0) continue;
      if (dot(normal(x[q.d], x[q.c], x[q.a]), up) <= 0 || joined(q.a, q.d, t)) continue;
      flip(q);
      ++flips;
    }
  return flips;
}

std::vector<std::array<int, 3>> triangulate_sphere(std::span<const Vec3> points) {
  struct Hull {
    qhT state{};
    Hull() { qh_zero(&state, nullptr); }
    ~Hull() {
      state.NOerrexit = True;
      qh_freeqhull(&state, !qh_ALL);
      int blocks = 0, bytes = 0;
      qh_memfreeshort(&state, &blocks, &bytes);
    }
  } hull;
  qhT* qh = &hull.state;
  std::vector<coordT> coordinates;
  for (const Vec3& p : points) coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
  char command[] = "qhull Qt";  // only triangles
  const int count = static_cast<int>(points.size());
  if (qh_new_qhull(qh, 3, count, coordinates.data(), False, command, nullptr, nullptr) != 0)
    throw Error("mesh: no convex hull of " + std::to_string(count) + " points");
  std::vector<std::array<int, 3>> triangles;
  facetT* facet;
  FORALLfacets {
    std::array<int, 3> t{};
    int j = 0;
    vertexT *vertex, **vertexp;
    FOREACHvertex_(facet->vertices) t.at(j++) = qh_pointid(qh, vertex->point);
    const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    if (dot(normal(a, b, c), a + b + c) < 0) std::swap(t[1], t[2]);
    triangles.push_back(t);
  }
  if (static_cast<int>(triangles.size()) != 2 * count - 4)
    throw Error("mesh: " + std::to_string(triangles.size()) + " triangles on the hull of " +
                std::to_string(count) + " points, expected " + std::to_string(2 * count - 4));
  return triangles;
}

}  // namespace hemomag::membrane
