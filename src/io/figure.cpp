#include "io/figure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/error.hpp"
#include "base/vec3.hpp"

namespace hemomag::io {
namespace {

constexpr double width = 420, height = 340;  // of a diagram, pixels
constexpr double left = 62, right = 14, top = 34, bottom = 48;

template <class... Args> std::string text(const char* format, Args... args) {
  char line[512];
  std::snprintf(line, sizeof line, format, args...);
  return line;
}

std::string escaped(const std::string& plain) {
  std::string out;
  for (const char c : plain)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

std::string document(double w, double h, const std::string& content) {
  return text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" "
              "viewBox=\"0 0 %g %g\" font-family=\"sans-serif\" font-size=\"12\">\n"
              "<rect width=\"%g\" height=\"%g\" fill=\"white\"/>\n",
              w, h, w, h, w, h) +
         content + "</svg>\n";
}

std::string word(double x, double y, const char* anchor, const std::string& what) {
  return text("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor) + escaped(what) +
         "</text>\n";
}

std::string stroke(double x0, double y0, double x1, double y1, const char* colour) {
  return text("<path d=\"M%.2f %.2fL%.2f %.2f\" stroke=\"%s\" fill=\"none\"/>\n", x0, y0, x1, y1,
              colour);
}

/// An axis: its ends and where its marks are.
struct Axis {
  double low = 0, high = 1, mark = 1;

  Axis(double least, double most, bool fixed) : low(least), high(most) {
    if (!(high > low)) high = low + 1;
    const double rough = (high - low) / 5, power = std::pow(10, std::floor(std::log10(rough)));
    const double leading = rough / power;
    mark = power * (leading < 1.5 ? 1 : leading < 3.5 ? 2 : leading < 7.5 ? 5 : 10);
    if (fixed) return;
    low = std::floor(low / mark) * mark;
    high = std::ceil(high / mark) * mark;
  }
  double share(double v) const { return (v - low) / (high - low); }
};

class Plot {
public:
  Plot(const Diagram& d, double offset)
      : d_(d), offset_(offset), x_(axis(d.x_range, &Series::x)), y_(axis(d.y_range, &Series::y)) {}

  std::string draw() {
    shade();
    frame();
    int row = 0;
    for (const Series& s : d_.series) {
      series(s);
      if (!s.label.empty()) legend(s, row++);
    }
    return out_;
  }

private:
  Axis axis(const std::vector<double>& range, std::vector<double> Series::*values) const {
    if (range.size() == 2) return {range[0], range[1], true};
    double least = 0, most = 0;
    bool first = true;
    for (const Series& s : d_.series)
      for (std::size_t i = 0; i < (s.*values).size(); ++i) {
        const double v = (s.*values)[i];
        const double bar = values == &Series::y && !s.spread.empty() ? s.spread[i] : 0;
        least = first ? v - bar : std::min(least, v - bar);
        most = first ? v + bar : std::max(most, v + bar);
        first = false;
      }
    if (first) throw Error("figure: the diagram " + d_.title + " has no points");
    return {least, most, false};
  }

  double px(double v) const { return offset_ + left + x_.share(v) * (width - left - right); }
  double py(double v) const { return height - bottom - y_.share(v) * (height - top - bottom); }

  void shade() {
    if (d_.shaded.size() != 2) return;
    out_ += text("<rect x=\"%.2f\" y=\"%g\" width=\"%.2f\" height=\"%g\" fill=\"#dddddd\"/>\n",
                 px(d_.shaded[0]), top, px(d_.shaded[1]) - px(d_.shaded[0]), height - top - bottom);
  }

  void frame() {
    out_ += text("<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"none\" "
                 "stroke=\"black\"/>\n",
                 offset_ + left, top, width - left - right, height - top - bottom);
    for (double v = std::ceil(x_.low / x_.mark - 1e-9) * x_.mark; v <= x_.high + 1e-9 * x_.mark;
         v += x_.mark) {
      out_ += stroke(px(v), py(y_.low), px(v), py(y_.low) + 5, "black");
      out_ += word(px(v), py(y_.low) + 18, "middle", text("%g", std::fabs(v) < 1e-12 ? 0 : v));
    }
    for (double v = std::ceil(y_.low / y_.mark - 1e-9) * y_.mark; v <= y_.high + 1e-9 * y_.mark;
         v += y_.mark) {
      out_ += stroke(px(x_.low) - 5, py(v), px(x_.low), py(v), "black");
      out_ += word(px(x_.low) - 8, py(v) + 4, "end", text("%g", std::fabs(v) < 1e-12 ? 0 : v));
    }
    const double middle = offset_ + (left + width - right) / 2;
    out_ += word(middle, top - 12, "middle", d_.title);
    out_ += word(middle, height - 12, "middle", d_.x_label);
    out_ += text("<text transform=\"translate(%.1f %.1f) rotate(-90)\" text-anchor=\"middle\">",
                 offset_ + 16, (top + height - bottom) / 2) +
            escaped(d_.y_label) + "</text>\n";
  }

  void path(const Series& s, const std::string& points) {
    out_ += "<path d=\"" + points + "\" fill=\"none\" stroke-width=\"1.6\" stroke=\"" + s.colour +
            (s.style == Series::Style::dashes ? "\" stroke-dasharray=\"6 4\"/>\n" : "\"/>\n");
  }

  void point(const Series& s, double x, double y) {
    const bool filled = s.style == Series::Style::dots;
    out_ += text("<circle cx=\"%.2f\" cy=\"%.2f\" r=\"3.2\" stroke=\"%s\" fill=\"%s\"/>\n", x, y,
                 s.colour.c_str(), filled ? s.colour.c_str() : "white");
  }

  static bool is_curve(const Series& s) {
    return s.style == Series::Style::line || s.style == Series::Style::dashes;
  }

  void series(const Series& s) {
    std::string points;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      const double x = px(s.x[i]), y = py(s.y[i]);
      if (!s.spread.empty())
        out_ += stroke(x, py(s.y[i] - s.spread[i]), x, py(s.y[i] + s.spread[i]), s.colour.c_str());
      points += text(i == 0 ? "M%.2f %.2f" : "L%.2f %.2f", x, y);
      if (!is_curve(s)) point(s, x, y);
    }
    if (is_curve(s)) path(s, points);
  }

  void legend(const Series& s, int row) {
    const double x = offset_ + left + 12, y = top + 16 + 16 * row;
    if (is_curve(s))
      path(s, text("M%.1f %.1fL%.1f %.1f", x, y - 4, x + 22, y - 4));
    else
      point(s, x + 11, y - 4);
    out_ += word(x + 28, y, "start", s.label);
  }

  const Diagram& d_;
  double offset_;
  Axis x_, y_;
  std::string out_;
};

/// A triangle of a picture, ready to be drawn.
struct Facet {
  double depth;
  std::array<Vec3, 3> corners;  // x to the right, y up, in length units
  double light;                 // 0 to 1
};

/// The facets that face the viewer, the farthest first.
std::vector<Facet> facets(const Body& body, double tilt) {
  const double c = std::cos(tilt * std::numbers::pi / 180);
  const double s = std::sin(tilt * std::numbers::pi / 180);
  std::vector<Vec3> seen;
  // Right, up, and towards the viewer.
  for (const auto& p : body.x) seen.push_back({p[0], p[2] * c + p[1] * s, p[2] * s - p[1] * c});
  std::vector<Facet> visible;
  for (const auto& t : body.triangles) {
    const Vec3 a = seen[static_cast<std::size_t>(t[0])], b = seen[static_cast<std::size_t>(t[1])],
               d = seen[static_cast<std::size_t>(t[2])];
    const Vec3 normal = cross(b - a, d - a);
    if (normal.z <= 0) continue;
    const Vec3 lamp = Vec3{-0.4, 0.5, 0.77} / norm(Vec3{-0.4, 0.5, 0.77});
    const bool dark = t[0] == body.marked || t[1] == body.marked || t[2] == body.marked;
    const double light = dark ? 0.1 : 0.35 + 0.65 * std::max(0.0, dot(normal, lamp) / norm(normal));
    visible.push_back({a.z + b.z + d.z, {a, b, d}, light});
  }
  std::sort(visible.begin(), visible.end(),
            [](const Facet& a, const Facet& b) { return a.depth < b.depth; });
  return visible;
}

std::string shade(const std::string& colour, double light) {
  const auto part = [&](std::size_t at) {
    return static_cast<int>(std::stoi(colour.substr(at, 2), nullptr, 16) * light);
  };
  return text("#%02x%02x%02x", part(1), part(3), part(5));
}

}  // namespace

std::string draw_diagrams(const std::vector<Diagram>& diagrams) {
  std::string content;
  for (std::size_t k = 0; k < diagrams.size(); ++k)
    content += Plot(diagrams[k], width * static_cast<double>(k)).draw();
  return document(width * static_cast<double>(diagrams.size()), height, content);
}

std::string draw_bodies(const std::vector<Body>& bodies, double tilt, double bar,
                        const std::string& bar_label) {
  constexpr double scale = 22, gap = 24, head = 34, foot = 44;  // pixels, per length unit first
  double at = gap, tallest = 0;
  struct Placed {
    std::vector<Facet> facets;
    double x0, x1, y0, y1;
  };
  std::vector<Placed> rows;
  for (const Body& body : bodies) {
    Placed p{facets(body, tilt), 0, 0, 0, 0};
    if (p.facets.empty()) throw Error("figure: the body " + body.label + " has no visible face");
    p.x0 = p.x1 = p.facets[0].corners[0].x;
    p.y0 = p.y1 = p.facets[0].corners[0].y;
    for (const Facet& f : p.facets)
      for (const Vec3& v : f.corners) {
        p.x0 = std::min(p.x0, v.x), p.x1 = std::max(p.x1, v.x);
        p.y0 = std::min(p.y0, v.y), p.y1 = std::max(p.y1, v.y);
      }
    tallest = std::max(tallest, (p.y1 - p.y0) * scale);
    rows.push_back(std::move(p));
  }
  std::string content;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Placed& p = rows[k];
    const double middle = head + tallest / 2 + (p.y0 + p.y1) / 2 * scale;
    for (const Facet& f : p.facets) {
      const std::string fill = shade(bodies[k].colour, f.light);
      content += "<path d=\"";
      for (std::size_t j = 0; j < 3; ++j)
        content += text("%c%.1f %.1f", j == 0 ? 'M' : 'L', at + (f.corners[j].x - p.x0) * scale,
                        middle - f.corners[j].y * scale);
      content += "Z\" fill=\"" + fill + "\" stroke=\"" + fill + "\" stroke-width=\"0.4\"/>\n";
    }
    content += word(at + (p.x1 - p.x0) * scale / 2, head - 14, "middle", bodies[k].label);
    at += (p.x1 - p.x0) * scale + gap;
  }
  const double floor = head + tallest + 20;
  content += stroke(gap, floor, gap + bar * scale, floor, "black");
  content += word(gap + bar * scale / 2, floor + 16, "middle", bar_label);
  return document(at, head + tallest + foot, content);
}

namespace {

/// An arrow from one point to another, in pixels.
std::string arrow(double x0, double y0, double x1, double y1, const std::string& colour,
                  double thickness) {
  const double dx = x1 - x0, dy = y1 - y0;
  constexpr double back = 0.35, aside = 0.18;  // of the head, over the length
  return text("<path d=\"M%.2f %.2fL%.2f %.2fM%.2f %.2fL%.2f %.2fL%.2f %.2f\" fill=\"none\" "
              "stroke-width=\"%g\" stroke=\"%s\"/>\n",
              x0, y0, x1, y1, x1 - back * dx - aside * dy, y1 - back * dy + aside * dx, x1, y1,
              x1 - back * dx + aside * dy, y1 - back * dy - aside * dx, thickness, colour.c_str());
}

std::string draw_flow(const FlowPicture& p, double left_edge, double top_edge, double scale) {
  const auto px = [&](double x) { return left_edge + x * scale; };
  const auto py = [&](double y) { return top_edge + (p.height - y) * scale; };
  std::string out = word(px(p.width / 2), top_edge - 12, "middle", p.label);
  for (const auto& [x, y, u, v] : p.flow) {
    const double share = std::min(1.0, std::hypot(u, v) / p.fastest);
    const double length = p.arrow / p.fastest;
    const auto colour = text("#%02x%02x%02x", static_cast<int>(30 + 200 * share), 60,
                             static_cast<int>(200 - 170 * share));
    out += arrow(px(x), py(y), px(x + u * length), py(y + v * length), colour, 1);
  }
  for (const auto& [x, y] : p.spheres)
    out += text("<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" fill=\"#555555\" "
                "stroke=\"black\"/>\n",
                px(x), py(y), p.radius * scale);
  if (const double n = std::hypot(p.axis[0], p.axis[1]); n > 0) {
    const double half = 0.06 * p.width, x = 0.1 * p.width, y = 0.9 * p.height;
    const double ex = half * p.axis[0] / n, ey = half * p.axis[1] / n;
    out += arrow(px(x - ex), py(y - ey), px(x + ex), py(y + ey), "black", 2);
  }
  return out + text("<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"none\" "
                    "stroke=\"black\"/>\n",
                    px(0), py(p.height), p.width * scale, p.height * scale);
}

}  // namespace

std::string draw_flows(const std::vector<FlowPicture>& pictures) {
  constexpr double side = 340, gap = 14, head = 34;  // pixels
  std::string content;
  double at = gap, tallest = 0;
  for (const FlowPicture& p : pictures) {
    const double scale = side / p.width;
    content += draw_flow(p, at, head, scale);
    tallest = std::max(tallest, p.height * scale);
    at += side + gap;
  }
  return document(at, head + tallest + gap, content);
}

}  // namespace hemomag::io
