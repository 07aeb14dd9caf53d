#include "io/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>

#include <zlib.h>

#include "base/error.hpp"
#include "base/vec3.hpp"

namespace hemomag::io {
namespace {

constexpr int samples = 2;  // along each side of a pixel
constexpr double margin = 12, head = 34, foot = 44;

using Colour = std::array<double, 3>;

/// Right, up, and towards the viewer.
class Camera {
public:
  explicit Camera(const View& v)
      : turn_(v.turn * std::numbers::pi / 180), tilt_(v.tilt * std::numbers::pi / 180) {}
  Vec3 operator()(const std::array<double, 3>& p) const {
    const double x = std::cos(turn_) * p[0] - std::sin(turn_) * p[1];
    const double y = std::sin(turn_) * p[0] + std::cos(turn_) * p[1];
    const double c = std::cos(tilt_), s = std::sin(tilt_);
    return {x, p[2] * c + y * s, p[2] * s - y * c};
  }

private:
  double turn_, tilt_;
};

Colour colour_of(const std::string& hex) {
  const auto part = [&](std::size_t at) { return 1.0 * std::stoi(hex.substr(at, 2), nullptr, 16); };
  return {part(1), part(3), part(5)};
}

/// Points of a picture with the depth of what is seen there.
class Canvas {
public:
  Canvas(int width, int height)
      : width_(width * samples), height_(height * samples),
        depth_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
               -std::numeric_limits<double>::infinity()),
        colour_(depth_.size(), Colour{255, 255, 255}) {}

  /// Corners in samples, z towards the viewer.
  void triangle(const std::array<Vec3, 3>& t, const Colour& colour) {
    const double area =
        (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
    if (area == 0) return;
    const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
    for (int j = static_cast<int>(std::ceil(y0)); j <= y1; ++j)
      for (int i = static_cast<int>(std::ceil(x0)); i <= x1; ++i) {
        const auto weight = [&](const Vec3& a, const Vec3& b) {
          return ((b.x - a.x) * (j - a.y) - (i - a.x) * (b.y - a.y)) / area;
        };
        const double w0 = weight(t[1], t[2]), w1 = weight(t[2], t[0]), w2 = weight(t[0], t[1]);
        if (w0 >= 0 && w1 >= 0 && w2 >= 0)
          point(i, j, w0 * t[0].z + w1 * t[1].z + w2 * t[2].z, colour);
      }
  }

  void line(const Vec3& a, const Vec3& b, const Colour& colour) {
    const int steps =
        1 + static_cast<int>(2 * std::max(std::fabs(b.x - a.x), std::fabs(b.y - a.y)));
    for (int k = 0; k <= steps; ++k) {
      const Vec3 p = a + (1.0 * k / steps) * (b - a);
      for (int di = 0; di < samples; ++di)
        for (int dj = 0; dj < samples; ++dj)
          point(static_cast<int>(p.x) + di, static_cast<int>(p.y) + dj, p.z, colour);
    }
  }

  /// A PNG file: 8 bits red, green, blue.
  std::string png() const {
    const int w = width_ / samples, h = height_ / samples;
    std::string rows;
    for (int j = 0; j < h; ++j) {
      rows += '\0';  // no filter
      for (int i = 0; i < w; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
          double sum = 0;
          for (int dj = 0; dj < samples; ++dj)
            for (int di = 0; di < samples; ++di)
              sum += colour_[index(i * samples + di, j * samples + dj)][c];
          rows += static_cast<char>(std::lround(sum / (samples * samples)));
        }
    }
    uLongf size = compressBound(rows.size());
    std::string packed(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                  reinterpret_cast<const Bytef*>(rows.data()), rows.size(), 9) != Z_OK)
      throw Error("figure: zlib could not compress the picture");
    packed.resize(size);
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", number(static_cast<std::uint32_t>(w)) +
                             number(static_cast<std::uint32_t>(h)) +
                             std::string("\x08\x02\0\0\0", 5)) +
           chunk("IDAT", packed) + chunk("IEND", "");
  }

private:
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(i);
  }
  void point(int i, int j, double z, const Colour& colour) {
    if (i < 0 || j < 0 || i >= width_ || j >= height_ || z <= depth_[index(i, j)]) return;
    depth_[index(i, j)] = z;
    colour_[index(i, j)] = colour;
  }
  static std::string number(std::uint32_t n) {
    return {static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8),
            static_cast<char>(n)};
  }
  static std::string chunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    const auto crc =
        crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return number(static_cast<std::uint32_t>(data.size())) + body +
           number(static_cast<std::uint32_t>(crc));
  }

  int width_, height_;
  std::vector<double> depth_;
  std::vector<Colour> colour_;
};

std::string base64(const std::string& bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t three = 0;
    for (std::size_t b = 0; b < 3; ++b)
      three = three << 8 | (k + b < bytes.size() ? static_cast<unsigned char>(bytes[k + b]) : 0U);
    for (std::size_t b = 0; b < 4; ++b)
      out += k + b > bytes.size() ? '=' : letters[three >> (18 - 6 * b) & 63];
  }
  return out;
}

/// What the scene covers on the screen, in length units.
struct Extent {
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  void include(const Vec3& p) {
    x0 = std::min(x0, p.x), x1 = std::max(x1, p.x);
    y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  }
};

Extent extent(const Scene& scene, const Camera& camera) {
  Extent e;
  for (const Body& b : scene.bodies)
    for (const auto& p : b.x) e.include(camera(p));
  for (const auto& l : scene.lines) e.include(camera(l[0])), e.include(camera(l[1]));
  if (e.x1 < e.x0) throw Error("figure: the scene " + scene.label + " has no point");
  return e;
}

std::string render(const Scene& scene, const Camera& camera, const Extent& e, double scale,
                   int width, int height) {
  Canvas canvas(width, height);
  const auto at = [&](const Vec3& p) {
    return Vec3{(p.x - e.x0) * scale * samples, (e.y1 - p.y) * scale * samples,
                p.z * scale * samples};
  };
  const Vec3 lamp = Vec3{-0.4, 0.5, 0.77} / norm(Vec3{-0.4, 0.5, 0.77});
  for (const Body& body : scene.bodies) {
    std::vector<Vec3> seen;
    for (const auto& p : body.x) seen.push_back(camera(p));
    const Colour colour = colour_of(body.colour);
    for (const auto& t : body.triangles) {
      const Vec3 a = seen[static_cast<std::size_t>(t[0])], b = seen[static_cast<std::size_t>(t[1])],
                 d = seen[static_cast<std::size_t>(t[2])];
      const Vec3 normal = cross(b - a, d - a);
      if (normal.z <= 0) continue;
      const double light = 0.35 + 0.65 * std::max(0.0, dot(normal, lamp) / norm(normal));
      canvas.triangle({at(a), at(b), at(d)},
                      {light * colour[0], light * colour[1], light * colour[2]});
    }
  }
  for (const auto& l : scene.lines) canvas.line(at(camera(l[0])), at(camera(l[1])), {70, 70, 70});
  return canvas.png();
}

}  // namespace

std::string draw_scenes(const std::vector<Scene>& scenes, const View& view) {
  const Camera camera(view);
  std::vector<Extent> extents;
  double tallest = 0, total = margin;
  for (const Scene& s : scenes) {
    extents.push_back(extent(s, camera));
    tallest = std::max(tallest, (extents.back().y1 - extents.back().y0) * view.scale);
    total += (extents.back().x1 - extents.back().x0) * view.scale + 2 * margin;
  }
  const double floor = head + tallest + 18;
  char line[512];
  std::snprintf(line, sizeof line,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
                "font-family=\"sans-serif\" font-size=\"13\">\n"
                "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n"
                "<path d=\"M%g %.1fh%.1f\" stroke=\"black\" stroke-width=\"2\"/>\n"
                "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>\n",
                total, floor + foot - 18, margin, floor, view.bar * view.scale,
                margin + view.bar * view.scale / 2, floor + 17, view.bar_label.c_str());
  std::string out = line;
  double x = margin;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const Extent& e = extents[k];
    const double w = (e.x1 - e.x0) * view.scale, h = (e.y1 - e.y0) * view.scale;
    const int width = static_cast<int>(w) + 2, height = static_cast<int>(h) + 2;
    std::snprintf(line, sizeof line,
                  "<text x=\"%.1f\" y=\"20\" text-anchor=\"middle\">%s</text>\n"
                  "<image x=\"%.1f\" y=\"%.1f\" width=\"%d\" height=\"%d\" "
                  "href=\"data:image/png;base64,",
                  x + w / 2, scenes[k].label.c_str(), x, head + (tallest - h) / 2, width, height);
    out += line + base64(render(scenes[k], camera, e, view.scale, width, height)) + "\"/>\n";
    x += w + 2 * margin;
  }
  return out + "</svg>\n";
}

}  // namespace hemomag::io
