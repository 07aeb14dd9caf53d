#pragma once
#include <array>
#include <string>
#include <vector>

// Plain figures as SVG: diagrams of curves and points, and shaded triangles.

namespace hemomag::io {

/// A curve or a set of points of a diagram. Colours are those of SVG.
struct Series {
  std::string label;
  std::string colour = "black";
  std::vector<double> x, y;
  std::vector<double> spread = {};  ///< half length of error bars in y, or empty
  enum class Style { line, dashes, dots, circles } style = Style::line;
};

/// One diagram with its own axes and legend.
struct Diagram {
  std::string title, x_label, y_label;
  std::vector<Series> series;
  std::vector<double> x_range = {}, y_range = {};  ///< {low, high}, or empty: what the data need
  std::vector<double> shaded = {};                 ///< {low, high} of x, or empty
};

/// Diagrams side by side as an SVG document. @throws Error when one has no points
std::string draw_diagrams(const std::vector<Diagram>& diagrams);

/// A picture of a closed surface seen from a direction.
struct Body {
  std::string label;
  std::vector<std::array<double, 3>> x;       ///< vertices
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::string colour = "#c0392b";             ///< #rrggbb, where the light falls straight
  int marked = -1;                            ///< a vertex whose triangles are dark, or none
};

/// Bodies in one row to one scale, seen along -y tilted downwards by `tilt` degrees (90: from
/// above), x to the right, with a bar of `bar` length units.
std::string draw_bodies(const std::vector<Body>& bodies, double tilt, double bar,
                        const std::string& bar_label);

/// Spheres in a plane with the flow around them.
struct FlowPicture {
  std::string label;
  double width = 0, height = 0;                ///< of the picture [length]
  std::vector<std::array<double, 2>> spheres;  ///< centres
  double radius = 0;
  std::vector<std::array<double, 4>> flow;  ///< x, y, and the velocity there
  double fastest = 0;                       ///< speed of the reddest, longest arrow
  double arrow = 0;                         ///< its length [length]
  std::array<double, 2> axis{};             ///< a direction to be marked, e.g. of a field
};

/// Pictures in one row, speeds from blue to red.
std::string draw_flows(const std::vector<FlowPicture>& pictures);

}  // namespace hemomag::io
