#pragma once
#include <span>

namespace hemomag::analysis {

enum class LayerWalls { lower, both };

/// Carriers in the cell-free layer next to the lower plate, or to both.
/// @param z      heights of carriers above the lower plate
/// @param layer  thickness of the layer
inline long in_layer(std::span<const double> z, double layer, double height, LayerWalls walls) {
  long n = 0;
  for (const double at : z)
    if (at <= layer || (walls == LayerWalls::both && at >= height - layer)) ++n;
  return n;
}

/// Margination probability at an instant, (n_f(t) - n_f(0))/(N - n_f(0)) (Eq. 46); 0 when all
/// started in the layer.
inline double margination_probability(long now, long at_start, long total) {
  return total > at_start
             ? static_cast<double>(now - at_start) / static_cast<double>(total - at_start)
             : 0.0;
}

}  // namespace hemomag::analysis
