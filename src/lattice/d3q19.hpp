#pragma once
#include <array>

/// The D3Q19 velocity set (Ye, Shen & Li 2018, Eq. 4), in the paper's order.
namespace hemomag::lattice::d3q19 {

inline constexpr int Q = 19;

inline constexpr std::array<std::array<int, 3>, Q> e = {{
    {0, 0, 0},   {1, 0, 0},  {-1, 0, 0}, {0, 1, 0},   {0, -1, 0},  {0, 0, 1},  {0, 0, -1},
    {1, 1, 0},   {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, 0, 1},   {-1, 0, 1}, {1, 0, -1},
    {-1, 0, -1}, {0, 1, 1},  {0, 1, -1}, {0, -1, 1},  {0, -1, -1},
}};

inline constexpr std::array<double, Q> w = [] {
  std::array<double, Q> weight{};
  for (int i = 0; i < Q; ++i) weight[i] = i == 0 ? 1.0 / 3 : i < 7 ? 1.0 / 18 : 1.0 / 36;
  return weight;
}();

/// opposite[i] is the direction -e_i.
inline constexpr std::array<int, Q> opposite = [] {
  std::array<int, Q> op{};
  for (int i = 0; i < Q; ++i)
    for (int k = 0; k < Q; ++k)
      if (e[k][0] == -e[i][0] && e[k][1] == -e[i][1] && e[k][2] == -e[i][2]) op[i] = k;
  return op;
}();

inline constexpr double cs2 = 1.0 / 3;  ///< speed of sound squared

/// The five directions with e[axis] == sign: those that cross a face normal to the axis.
constexpr std::array<int, 5> crossing(int axis, int sign) {
  std::array<int, 5> found{};
  int n = 0;
  for (int i = 0; i < Q; ++i)
    if (e[i][axis] == sign) found[n++] = i;
  return found;
}

}  // namespace hemomag::lattice::d3q19
