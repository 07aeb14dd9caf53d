// Figures hold what they are given: every point, every error bar, every face that can be seen.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/figure.hpp"

namespace {

using namespace hemomag;

int count(const std::string& text, const std::string& what) {
  int n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(Figure, ADiagramHasEveryPointAtItsPlace) {
  io::Series s{"a < b", "red", {0, 5, 10}, {0, 1, 2}, {}, io::Series::Style::circles};
  const std::string svg = io::draw_diagrams({{"t", "x", "y", {s}, {0, 10}, {0, 2}}});
  EXPECT_EQ(count(svg, "<circle"), 4);  // three points and the legend's
  // The frame runs from 62 to 406 and from 34 to 292: the middle point is in its middle.
  EXPECT_EQ(count(svg, "cx=\"234.00\" cy=\"163.00\""), 1);
  EXPECT_EQ(count(svg, "a &lt; b"), 1);
  s.spread = {0.1, 0.1, 0.1};
  const std::string bars = io::draw_diagrams({{"t", "x", "y", {s}, {0, 10}, {0, 2}}});
  EXPECT_EQ(count(bars, "stroke=\"red\" fill=\"none\""), 3);
}

TEST(Figure, ABandIsShadedBehindTheFrame) {
  const io::Series s{"", "red", {0, 10}, {0, 2}};
  io::Diagram d{"t", "x", "y", {s}, {0, 10}, {0, 2}};
  d.shaded = {2.5, 5};  // a quarter of the frame's width of 344, from 62 + 86
  const std::string svg = io::draw_diagrams({d});
  EXPECT_EQ(count(svg, "<rect x=\"148.00\" y=\"34\" width=\"86.00\" height=\"258\""), 1);
}

TEST(Figure, ADiagramWithoutPointsIsRefused) {
  EXPECT_THROW(io::draw_diagrams({{"empty", "x", "y", {}, {}, {}}}), Error);
}

TEST(Figure, ABodyShowsTheFacesTurnedToTheViewer) {
  // A tetrahedron on its base: from above, three faces are seen.
  io::Body body;
  body.label = "tetrahedron";
  body.x = {{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 0.7, 1}};
  body.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const std::string svg = io::draw_bodies({body}, 90, 1, "1 um");
  EXPECT_EQ(count(svg, "Z\" fill"), 3);
  body.marked = 1;  // two of the three meet there
  EXPECT_EQ(count(io::draw_bodies({body}, 90, 1, "1 um"), "fill=\"#130504\""), 2);
}

TEST(Figure, AFlowHasItsSpheresAndArrowsToScale) {
  io::FlowPicture p;
  p.label = "flow";
  p.width = p.height = 10;
  p.radius = 1;
  p.spheres = {{2, 5}, {8, 5}};
  p.flow = {{5, 5, 1, 0}, {5, 2, 0, -4}};
  p.fastest = 2;
  p.arrow = 3;
  const std::string svg = io::draw_flows({p});
  // 34 pixels a unit from the corner (14, 34), y upwards.
  EXPECT_EQ(count(svg, "cx=\"82.00\" cy=\"204.00\" r=\"34.00\""), 1);
  EXPECT_EQ(count(svg, "cx=\"286.00\" cy=\"204.00\""), 1);
  EXPECT_EQ(count(svg, "M184.00 204.00L235.00 204.00"), 1) << "half the fastest: 1.5 units long";
  EXPECT_EQ(count(svg, "M184.00 306.00L184.00 510.00"), 1);
  EXPECT_EQ(count(svg, "#e63c1e"), 1) << "faster than the fastest is as red";
}

}  // namespace
