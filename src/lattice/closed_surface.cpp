#include "lattice/closed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <unordered_map>

#include "base/error.hpp"

namespace hemomag::lattice {
namespace {

using Triangle = std::array<int, 3>;

// Keeps third powers of lengths far from overflow. Single precision ends at 3.4e38.
constexpr double largest_coordinate = 1e40;

// A triangle lower than this fraction of its longest edge has a normal of pure round-off.
constexpr double least_height = 64 * std::numeric_limits<double>::epsilon();

// A surface that encloses less than this fraction of its diagonal cubed is a folded sheet.
constexpr double least_volume = 1e-12;

std::string text(const Vec3& x) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "(%.6g, %.6g, %.6g)", x.x, x.y, x.z);
  return buffer;
}

void require_sound(const Surface& surface, const std::string& name) {
  const auto n = surface.points.size();
  if (surface.triangles.empty())
    throw Error(name + ": holds no triangles; accepted is a closed surface");
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t d = 0; d < 3; ++d)
      if (!(std::abs(surface.points[i][d]) <= largest_coordinate))
        throw Error(name + ": point " + std::to_string(i) + " is at " + text(surface.points[i]) +
                    "; accepted are finite coordinates up to 1e40");
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int v : surface.triangles[t])
      if (v < 0 || static_cast<std::size_t>(v) >= n)
        throw Error(name + ": triangle " + std::to_string(t) + " names point " + std::to_string(v) +
                    "; accepted are 0 to " + std::to_string(n) + " - 1");
}

struct Box {
  Vec3 low, high;
  double diagonal() const { return norm(high - low); }
};

Box bounding_box(const std::vector<Vec3>& points) {
  Box box{points[0], points[0]};
  for (const Vec3& x : points)
    for (std::size_t d = 0; d < 3; ++d) {
      box.low[d] = std::min(box.low[d], x[d]);
      box.high[d] = std::max(box.high[d], x[d]);
    }
  return box;
}

/// The points kept by `weld`, sorted into cubes a few weld distances wide. Kept points are further
/// apart than one, so that a cube holds few.
class PointGrid {
public:
  explicit PointGrid(const Box& box)
      : low_(box.low), reach_(weld_distance * box.diagonal()),
        width_(reach_ > 0 ? 4 * reach_ : 1.0) {}

  /// The first point within reach of x, or, if there is none, x itself, which is then kept.
  int find_or_keep(const Vec3& x, std::vector<Vec3>& kept) {
    std::array<std::int64_t, 3> from, to;
    for (std::size_t d = 0; d < 3; ++d) {
      from[d] = cube(x[d] - reach_, d);
      to[d] = cube(x[d] + reach_, d);
    }
    int found = none;
    for (auto i = from[0]; i <= to[0]; ++i)
      for (auto j = from[1]; j <= to[1]; ++j)
        for (auto k = from[2]; k <= to[2]; ++k) {
          const auto first = first_.find(key(i, j, k));
          if (first == first_.end()) continue;
          for (int p = first->second; p != none; p = next_[static_cast<std::size_t>(p)])
            if ((found == none || p < found) &&
                norm2(kept[static_cast<std::size_t>(p)] - x) <= reach_ * reach_)
              found = p;
        }
    if (found != none) return found;
    const int mine = static_cast<int>(kept.size());
    kept.push_back(x);
    auto& first =
        first_.try_emplace(key(cube(x.x, 0), cube(x.y, 1), cube(x.z, 2)), none).first->second;
    next_.push_back(first);
    first = mine;
    return mine;
  }

private:
  static constexpr int none = -1;

  std::int64_t cube(double x, std::size_t d) const {
    return static_cast<std::int64_t>(std::floor((x - low_[d]) / width_));
  }
  // At most 250,001 cubes a side, and one more to either side that is looked at: 20 bits each.
  static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<std::uint64_t>(((i + 1) << 40) | ((j + 1) << 20) | (k + 1));
  }

  Vec3 low_;
  double reach_, width_;
  std::unordered_map<std::uint64_t, int> first_;  // cube -> its last kept point
  std::vector<int> next_;                         // kept point -> the one before it in its cube
};

bool repeats_a_corner(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// The k for which corner k lies on the edge of the two others, which is the longest; -1 for a
/// triangle that has an area.
int flat_corner(const std::vector<Vec3>& points, const Triangle& t) {
  const auto x = [&](int k) {
    return points[static_cast<std::size_t>(t[static_cast<std::size_t>(k % 3)])];
  };
  int corner = 0;
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    if (const double l2 = norm2(x(k + 2) - x(k + 1)); l2 > longest) longest = l2, corner = k;
  const double area = norm(cross(x(1) - x(0), x(2) - x(0)));
  return area > least_height * longest ? -1 : corner;
}

std::uint64_t directed(int a, int b) {
  return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
}

/// One round of the removal drawn in the header. Triangles that already changed in this round wait
/// for the next.
/// @return the number of flat triangles met
int remove_flat_triangles(Surface& surface) {
  auto& triangles = surface.triangles;
  std::vector<std::size_t> flat;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (flat_corner(surface.points, triangles[t]) >= 0) flat.push_back(t);
  if (flat.empty()) return 0;

  std::unordered_map<std::uint64_t, std::size_t> triangle_on;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      triangle_on[directed(triangles[t][k], triangles[t][(k + 1) % 3])] = t;
  std::vector<char> changed(triangles.size(), 0);
  for (const auto t : flat) {
    if (changed[t]) continue;
    const auto k = static_cast<std::size_t>(flat_corner(surface.points, triangles[t]));
    const int m = triangles[t][k];
    const int b = triangles[t][(k + 1) % 3];
    const int a = triangles[t][(k + 2) % 3];
    const auto other = triangle_on.find(directed(a, b));
    if (other == triangle_on.end() || changed[other->second]) continue;
    const auto n = other->second;
    int d = m;
    for (int v : triangles[n])
      if (v != a && v != b) d = v;
    triangles[n] = {a, m, d};  // repeats a corner, and goes, when the two lie back to back
    triangles[t] = {m, b, d};
    changed[t] = changed[n] = 1;
  }
  std::erase_if(triangles, repeats_a_corner);
  return static_cast<int>(flat.size());
}

/// Every edge as the number (lower point, higher point, sense), sorted.
std::vector<std::uint64_t> sorted_edges(const std::vector<Triangle>& triangles) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      edges.push_back(directed(std::min(a, b), std::max(a, b)) << 1 | (a < b));
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

void require_paired_edges(const Surface& surface, const std::string& name) {
  const auto edges = sorted_edges(surface.triangles);
  std::size_t open = 0, crowded = 0, turned = 0;
  std::uint64_t example = 0;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end] >> 1 == edges[i] >> 1) ++end;
    const auto count = end - i;
    if (count == 2 && edges[i] != edges[i + 1]) continue;
    if (open + crowded + turned == 0) example = edges[i] >> 1;
    ++(count == 1 ? open : count > 2 ? crowded : turned);
  }
  if (open + crowded + turned == 0) return;
  const Vec3 where = 0.5 * (surface.points[example >> 32] + surface.points[example & 0xffffffffu]);
  throw Error(name + ": " + std::to_string(open) + " open edges, " + std::to_string(crowded) +
              " edges of more than two triangles and " + std::to_string(turned) +
              " edges between triangles turned against each other, one of them at " + text(where) +
              "; accepted is a closed surface");
}

double signed_volume(const Surface& surface, const Vec3& origin) {
  double six = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto x = [&](int v) { return surface.points[static_cast<std::size_t>(v)] - origin; };
    six += dot(x(a), cross(x(b), x(c)));
  }
  return six / 6;
}

void remove_unused_points(Surface& surface) {
  std::vector<int> number(surface.points.size(), -1);
  for (const Triangle& t : surface.triangles)
    for (int v : t) number[static_cast<std::size_t>(v)] = 0;
  int used = 0;
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] == 0) {
      surface.points[static_cast<std::size_t>(used)] = surface.points[i];
      number[i] = used++;
    }
  surface.points.resize(static_cast<std::size_t>(used));
  for (Triangle& t : surface.triangles)
    for (int& v : t) v = number[static_cast<std::size_t>(v)];
}

}  // namespace

void weld(Surface& surface, const std::string& name) {
  require_sound(surface, name);
  PointGrid grid(bounding_box(surface.points));
  std::vector<Vec3> kept;
  std::vector<int> number;
  number.reserve(surface.points.size());
  for (const Vec3& x : surface.points) number.push_back(grid.find_or_keep(x, kept));
  for (Triangle& t : surface.triangles)
    for (int& v : t) v = number[static_cast<std::size_t>(v)];
  surface.points = std::move(kept);
}

Surface closed(Surface surface, const std::string& name) {
  require_sound(surface, name);
  std::erase_if(surface.triangles, repeats_a_corner);
  require_paired_edges(surface, name);

  // A removal can leave a flat triangle for the next round; rows of them shorten every time.
  constexpr int rounds = 16;
  for (int round = 0, flat = 1; flat > 0; ++round) {
    flat = remove_flat_triangles(surface);
    if (flat > 0 && round == rounds)
      throw Error(name + ": " + std::to_string(flat) +
                  " triangles without area cannot be removed; accepted is a closed surface");
  }
  require_paired_edges(surface, name);
  remove_unused_points(surface);
  if (surface.triangles.empty())
    throw Error(name + ": no triangle has an area; accepted is a closed surface");

  const Box box = bounding_box(surface.points);
  const double volume = signed_volume(surface, 0.5 * (box.low + box.high));
  if (std::abs(volume) <= least_volume * std::pow(box.diagonal(), 3))
    throw Error(name + ": encloses no volume; accepted is a closed surface");
  if (volume < 0)
    for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  return surface;
}

}  // namespace hemomag::lattice
