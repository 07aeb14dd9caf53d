#pragma once
#include <array>
#include <string>
#include <vector>

#include "io/figure.hpp"

namespace hemomag::io {

/// Bodies and lines in space.
struct Scene {
  std::string label;
  std::vector<Body> bodies;
  std::vector<std::array<std::array<double, 3>, 2>> lines;  ///< drawn thin, hidden by bodies
};

/// How scenes are looked at: without perspective, turned about z, then from above by `tilt`.
struct View {
  double turn = 30, tilt = 20;  ///< degrees
  double scale = 14;            ///< pixels a length unit
  double bar = 10;              ///< length of the scale bar
  std::string bar_label;
};

/// Scenes in one row to one scale as an SVG document: shaded and hidden point by point, each an
/// embedded PNG. @throws Error when a scene has no point
std::string draw_scenes(const std::vector<Scene>& scenes, const View& view);

}  // namespace hemomag::io
