#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "lattice/surface.hpp"

namespace hemomag::test {

using lattice::Surface;

/// The cube [0, side]^3 of twelve triangles.
inline Surface cube(double side) {
  Surface s;
  for (int i = 0; i < 8; ++i)
    s.points.push_back(side * Vec3{double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
        std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
    s.triangles.push_back({a, b, c});
    s.triangles.push_back({a, c, d});
  }
  return s;
}

/// A sphere about the origin: an icosahedron whose triangles are cut in four `levels` times.
inline Surface icosphere(double radius, int levels) {
  const double g = std::numbers::phi;
  Surface s;
  s.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  s.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                 {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                 {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                 {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), int(s.points.size()));
      if (fresh) s.points.push_back(0.5 * (s.points[std::size_t(a)] + s.points[std::size_t(b)]));
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : s.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& t : {std::array{a, ab, ca}, std::array{b, bc, ab}, std::array{c, ca, bc},
                            std::array{ab, bc, ca}})
        finer.push_back(t);
    }
    s.triangles = finer;
  }
  for (Vec3& x : s.points) x *= radius / norm(x);
  return s;
}

/// A torus about the z axis through the origin.
inline Surface torus(double ring, double tube, int n_ring, int n_tube) {
  Surface s;
  for (int i = 0; i < n_ring; ++i)
    for (int j = 0; j < n_tube; ++j) {
      const double p = 2 * std::numbers::pi * i / n_ring, q = 2 * std::numbers::pi * j / n_tube;
      const double r = ring + tube * std::cos(q);
      s.points.push_back({r * std::cos(p), r * std::sin(p), tube * std::sin(q)});
      const auto at = [&](int k, int l) { return (k % n_ring) * n_tube + l % n_tube; };
      s.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      s.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return s;
}

/// A sphere whose points are drawn in or out at random: sharp ridges, spikes and pits.
inline Surface spiky(double radius, int levels) {
  Surface s = icosphere(radius, levels);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> factor(0.4, 1.6);
  for (Vec3& x : s.points) x *= factor(random);
  return s;
}

}  // namespace hemomag::test
