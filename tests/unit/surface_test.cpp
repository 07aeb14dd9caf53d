// Surfaces are the same from every format; what is not a closed surface is refused by name.
#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/error.hpp"
#include "io/files.hpp"
#include "io/surface_file.hpp"
#include "lattice/closed_surface.hpp"
#include "lattice/surface_vessel.hpp"
#include "support/shapes.hpp"

namespace {

using namespace hemomag;
using lattice::Surface;

/// A torus whose coordinates single precision holds, so that all formats can hold it exactly.
Surface shape() {
  Surface s = test::torus(6, 2.5, 12, 8);
  for (Vec3& x : s.points)
    for (std::size_t d = 0; d < 3; ++d) x[d] = float(x[d]);
  return s;
}

template <class T> std::string raw(T value, std::endian order = std::endian::little) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return {bytes.data(), bytes.size()};
}

std::string stl_binary(const Surface& s, std::string header = "solid, says a careless writer") {
  header.resize(80, ' ');
  std::string out = header + raw(std::uint32_t(s.triangles.size()));
  for (const auto& t : s.triangles) {
    out += raw(0.0f) + raw(0.0f) + raw(0.0f);
    for (int v : t)
      for (std::size_t d = 0; d < 3; ++d) out += raw(float(s.points[std::size_t(v)][d]));
    out += raw(std::uint16_t{0});
  }
  return out;
}

std::string stl_text(const Surface& s) {
  std::ostringstream out;
  out.precision(17);
  out << "solid facet of a name\n";
  for (const auto& t : s.triangles) {
    out << " facet normal 0 0 nan\n  outer loop\n";
    for (int v : t) {
      const Vec3& x = s.points[std::size_t(v)];
      out << "   VERTEX " << x.x << ' ' << x.y << ' ' << x.z << "\r\n";
    }
    out << "  endloop\n endfacet\n";
  }
  out << "endsolid facet of a name\n";
  return out.str();
}

std::string off(const Surface& s) {
  std::ostringstream out;
  out.precision(17);
  out << "# a comment\nCOFF\n" << s.points.size() << ' ' << s.triangles.size() << " 0\n\n";
  for (const Vec3& x : s.points) out << x.x << ' ' << x.y << ' ' << x.z << " 255 0 0 255 # red\n";
  for (const auto& [a, b, c] : s.triangles) out << "3 " << a << ' ' << b << ' ' << c << " 7\n";
  return out.str();
}

std::string ply_head(const Surface& s, const std::string& format) {
  return "ply\nformat " + format + " 1.0\ncomment element face 1\nelement vertex " +
         std::to_string(s.points.size()) +
         "\nproperty double x\nproperty uchar red\nproperty float32 y\nproperty double z\n"
         "element strip 1\nproperty list uchar short of\nelement face " +
         std::to_string(s.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nproperty float quality\nend_header\n";
}

std::string ply_text(const Surface& s) {
  std::ostringstream out;
  out.precision(17);
  out << ply_head(s, "ascii");
  for (const Vec3& x : s.points) out << x.x << " 255 " << x.y << ' ' << x.z << '\n';
  out << "2 -1 -2\n";
  for (const auto& [a, b, c] : s.triangles) out << "3 " << a << ' ' << b << ' ' << c << " 0.5\n";
  return out.str();
}

std::string ply_binary(const Surface& s, std::endian order) {
  std::string out =
      ply_head(s, order == std::endian::little ? "binary_little_endian" : "binary_big_endian");
  for (const Vec3& x : s.points)
    out += raw(x.x, order) + raw(char(-1)) + raw(float(x.y), order) + raw(x.z, order);
  out += raw(char(2)) + raw(std::int16_t(-1), order) + raw(std::int16_t(-2), order);
  for (const auto& t : s.triangles) {
    out += raw(char(3));
    for (int v : t) out += raw(v, order);
    out += raw(0.5f, order);
  }
  return out;
}

/// The triangles by coordinates, each from its lowest corner on, sorted.
auto canonical(const Surface& s) {
  std::vector<std::array<std::array<double, 3>, 3>> found;
  for (const auto& t : s.triangles) {
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& x = s.points[std::size_t(t[k])];
      corners[k] = {x.x, x.y, x.z};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    found.push_back(corners);
  }
  std::sort(found.begin(), found.end());
  return found;
}

class SurfaceFile : public testing::Test {
protected:
  void SetUp() override { io::make_directory(directory_); }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string write(const std::string& name, const std::string& bytes) const {
    const std::string path = directory_ + "/" + name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  Surface read(const std::string& name, const std::string& bytes) const {
    return io::read_surface(write(name, bytes));
  }
  /// The message with which a file is refused, without its directory; empty if it is not.
  std::string refusal(const std::string& name, const std::string& bytes) const {
    const std::string path = write(name, bytes);
    try {
      io::read_surface(path);
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find(path), 0u) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      return message.substr(directory_.size() + 1);
    }
    return "";
  }
  void expect_refused(const std::string& name, const std::string& bytes,
                      const std::string& reason) const {
    const std::string message = refusal(name, bytes);
    EXPECT_NE(message.find(reason), std::string::npos)
        << name << ": '" << message << "' lacks '" << reason << "'";
  }

  const std::string directory_ =
      (std::filesystem::temp_directory_path() / ("hemomag_surface_" + std::to_string(getpid())))
          .string();
};

TEST_F(SurfaceFile, EveryFormatGivesTheSameSurface) {
  const Surface s = shape();
  const auto expected = canonical(s);
  for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
           {"binary.stl", stl_binary(s)},
           {"plain.STL", stl_binary(s, "")},
           {"text.stl", stl_text(s)},
           {"a.off", off(s)},
           {"text.ply", ply_text(s)},
           {"little.Ply", ply_binary(s, std::endian::little)},
           {"big.ply", ply_binary(s, std::endian::big)}}) {
    const Surface found = read(name, bytes);
    EXPECT_EQ(found.points.size(), s.points.size()) << name;
    EXPECT_EQ(canonical(found), expected) << name;
  }
}

TEST_F(SurfaceFile, PointsOfIndexedFormatsKeepTheirOrder) {
  const Surface s = shape();
  EXPECT_EQ(read("a.off", off(s)).points, s.points);
  EXPECT_EQ(read("a.ply", ply_text(s)).triangles, s.triangles);
}

TEST_F(SurfaceFile, SeveralSolidsOfATextAreOneSurface) {
  Surface far = shape();
  for (Vec3& x : far.points) x.z += 100;
  EXPECT_EQ(read("two.stl", stl_text(shape()) + stl_text(far)).triangles.size(),
            2 * far.triangles.size());
}

TEST_F(SurfaceFile, CornersThatAlmostCoincideAreJoined) {
  Surface s = shape();
  const Vec3 low = s.points[0];
  std::string text = stl_text(s);
  // 5e-7 of the diagonal, which is 24.6: within the distance of welding, and far above round-off.
  std::ostringstream from, to;
  from.precision(17), to.precision(17);
  from << "VERTEX " << low.x << ' ';
  to << "VERTEX " << low.x + 1.2e-5 << ' ';
  const auto at = text.find(from.str());
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(
      read("near.stl", std::string(text).replace(at, from.str().size(), to.str())).points.size(),
      s.points.size());
  std::ostringstream further;
  further.precision(17);
  further << "VERTEX " << low.x + 5e-5 << ' ';
  expect_refused("far.stl", text.replace(at, from.str().size(), further.str()),
                 "4 open edges");  // two, each with two sides
}

TEST_F(SurfaceFile, PolygonsAreCutIntoFans) {
  const std::string box =
      "OFF 9 6 12\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n5 5 5\n"
      "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  const Surface s = read("box.off", box);
  EXPECT_EQ(canonical(s), canonical(test::cube(1)));
  EXPECT_EQ(s.points.size(), 8u);  // the ninth is of no triangle
}

TEST_F(SurfaceFile, InwardSurfacesAreTurnedOutward) {
  Surface inward = shape();
  for (auto& t : inward.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(canonical(read("inward.stl", stl_binary(inward))), canonical(shape()));
}

double volume(const Surface& s) {
  double six = 0;
  for (const auto& [a, b, c] : s.triangles)
    six += dot(s.points[std::size_t(a)], cross(s.points[std::size_t(b)], s.points[std::size_t(c)]));
  return six / 6;
}

TEST_F(SurfaceFile, DegenerateTrianglesGoAndTheSurfaceStaysClosed) {
  Surface pinched = test::cube(1);
  pinched.triangles.push_back({3, 3, 5});
  EXPECT_EQ(canonical(lattice::closed(pinched, "s")), canonical(test::cube(1)));

  // Point 8 halves edge 0-1. One side of the edge uses it, the other side meets it through the
  // triangle 0 1 8 that has no area.
  Surface flat = test::cube(1);
  flat.points.push_back({0.5, 0, 0});
  const std::array below{0, 3, 1};
  const auto at = std::find(flat.triangles.begin(), flat.triangles.end(), below);
  ASSERT_NE(at, flat.triangles.end());
  *at = {0, 3, 8};
  flat.triangles.push_back({8, 3, 1});
  flat.triangles.push_back({0, 8, 1});
  const Surface mended = lattice::closed(flat, "s");
  EXPECT_EQ(mended.triangles.size(), 14u);
  EXPECT_DOUBLE_EQ(volume(mended), 1);

  // A pair of such triangles back to back goes without a trace.
  Surface leaf = test::cube(1);
  leaf.points.push_back({0.5, 0, 0});
  leaf.triangles.push_back({0, 8, 1});
  leaf.triangles.push_back({0, 1, 8});
  EXPECT_THROW(lattice::closed(leaf, "s"), Error);  // its edge 0-1 is of four triangles
}

TEST_F(SurfaceFile, RowsOfFlatTrianglesGoOneAfterTheOther) {
  // Points 8 and 9 cut edge 0-1 in three; the fan of the lower side has two flat triangles there.
  const std::string box =
      "OFF 10 6 0\n0 0 0\n3 0 0\n0 3 0\n3 3 0\n0 0 3\n3 0 3\n0 3 3\n3 3 3\n1 0 0\n2 0 0\n"
      "6 0 2 3 1 9 8\n4 4 5 7 6\n6 5 4 0 8 9 1\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  const Surface s = read("box.off", box);
  EXPECT_EQ(s.points.size(), 10u);
  EXPECT_EQ(s.triangles.size(), 16u);  // 2 (points) - 4, as for every closed surface like a sphere
  EXPECT_DOUBLE_EQ(volume(s), 27);
  for (const auto& [a, b, c] : s.triangles) {
    const auto x = [&](int v) { return s.points[std::size_t(v)]; };
    EXPECT_GT(norm(cross(x(b) - x(a), x(c) - x(a))), 1);
  }
}

TEST_F(SurfaceFile, FaultsOfTheSurfaceAreCounted) {
  Surface s = test::cube(1);
  s.triangles.pop_back();
  expect_refused("open.stl", stl_binary(s), "3 open edges, 0 edges of more than two");
  expect_refused("open.off", off(s), "accepted is a closed surface");

  s = test::cube(1);
  std::swap(s.triangles[0][1], s.triangles[0][2]);
  expect_refused("turned.stl", stl_text(s),
                 "0 open edges, 0 edges of more than two triangles and 3 "
                 "edges between triangles turned against each other");
  s = test::cube(1);
  s.triangles.push_back(s.triangles[0]);
  expect_refused("twice.ply", ply_text(s), "3 edges of more than two triangles");

  s = test::cube(2);
  s.points.push_back({9, 9, 9});
  s.triangles.push_back({0, 1, 8});
  expect_refused("fin.off", off(s), "2 open edges, 1 edges of more than two");
  expect_refused("fin.off", off(s), "one of them at (1, 0, 0)");

  s = test::cube(1);
  s.triangles = {{0, 1, 2}, {0, 2, 1}};
  expect_refused("sheet.off", off(s), "encloses no volume");
  s.triangles = {{0, 0, 1}};
  expect_refused("line.off", off(s), "no triangle has an area");
}

std::string with(std::string text, const std::string& old, const std::string& fresh) {
  const auto at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("no " + old);
  return text.replace(at, old.size(), fresh);
}

TEST_F(SurfaceFile, MalformedFilesAreRefusedWithTheReason) {
  const Surface s = test::cube(1);
  const std::string binary = stl_binary(s), text = stl_text(s), o = off(s), p = ply_text(s),
                    little = ply_binary(s, std::endian::little);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string absurd = "\xff\xff\xff\xff";

  expect_refused("a.obj", text, "'.obj'; accepted are surfaces in .stl, .off and .ply files");
  expect_refused("a", text, "no ending");
  for (const char* name : {"a.stl", "a.off", "a.ply"})
    expect_refused(name, "", "the file is empty");

  expect_refused("short.stl", "solid", "the file ends before 'endsolid'");
  expect_refused("tiny.stl", "liquid", "has 6 bytes");
  expect_refused("cut.stl", binary.substr(0, binary.size() - 1),
                 "counts 12 triangles, for which binary STL has 684 bytes, but it has 683");
  expect_refused("long.stl", binary + "x", "but it has 685");
  expect_refused("absurd.stl", std::string(binary).replace(80, 4, absurd), "counts 4294967295");
  expect_refused("none.stl", stl_binary(Surface{}), "holds no triangles");
  expect_refused("nan.stl", std::string(binary).replace(84 + 12, 4, raw(nan)),
                 "point 0 is at (nan, 0, 0); accepted are finite");
  expect_refused("nan.stl", with(text, "VERTEX 0 0 0", "vertex 0 -inf 0"),
                 "point 0 is at (0, -inf, 0)");
  expect_refused("word.stl", with(text, "VERTEX 0 0 0", "vertex 0 zero 0"),
                 "line 4: 'zero' is not a number");
  expect_refused("large.stl", with(text, "VERTEX 0 0 0", "vertex 0 1e999 0"),
                 "'1e999' is not a number");
  expect_refused("four.stl", with(text, "  endloop", "vertex 0 0 0\nendloop"),
                 "line 7: 'vertex' where 'endloop' must be");
  expect_refused("stop.stl", text.substr(0, text.size() / 2), "the file ends before");
  expect_refused("end.stl", text.substr(0, text.find("endsolid")),
                 "the file ends before 'endsolid'");

  expect_refused("word.off", with(o, "COFF", "MESH"), "line 2: 'MESH' where 'OFF' must be");
  expect_refused("stop.off", o.substr(0, o.size() - 12), "the file ends before the last face");
  expect_refused("absurd.off", with(o, "8 12 0", "2000000000 12 0"),
                 "counts 2000000000 points, but only");
  expect_refused("absurd.off", with(o, "8 12 0", "8 1e30 0"),
                 "the count of faces is not a whole number");
  expect_refused("minus.off", with(o, "8 12 0", "-8 12 0"),
                 "the count of points is not a whole number");
  expect_refused("index.off", with(o, "3 0 2 3", "3 0 2 8"),
                 "triangle 0 names point 8; accepted are 0 to 8 - 1");
  expect_refused("index.off", with(o, "3 0 2 3", "3 0 2 -3"), "a corner is not a whole number");
  expect_refused("corners.off", with(o, "3 0 2 3 7", "9 0 2 3 7"), "a face of 9 corners names 4");
  expect_refused("corners.off", with(o, "3 0 2 3", "2 0 2 3"),
                 "a face has 2 corners; accepted are 3 or more");
  expect_refused("nan.off", with(o, "\n0 0 0 ", "\n0 nan 0 "), "point 0 is at (0, nan, 0)");
  expect_refused("two.off", with(o, "\n0 0 0 255 0 0 255", "\n0 0"),
                 "a point has three coordinates");

  expect_refused("word.ply", with(p, "ply", "plyx"), "'plyx' where 'ply' must be");
  expect_refused("format.ply", with(p, "ascii", "binary_middle_endian"),
                 "'binary_middle_endian' is not accepted");
  expect_refused("format.ply", with(p, "format ascii 1.0\n", ""), "has no 'format'");
  expect_refused("type.ply", with(p, "property double x", "property real x"),
                 "'real' is not a type");
  expect_refused("x.ply", with(p, "double x", "double ex"), "element 'vertex' has no property x");
  expect_refused("list.ply", with(p, "vertex_indices", "corners"),
                 "element 'face' has no property vertex_indices");
  expect_refused("head.ply", p.substr(0, p.find("end_header")),
                 "the file ends before 'end_header'");
  expect_refused("absurd.ply", with(p, "vertex 8", "vertex 2000000000"),
                 "counts 2000000000 elements, but only");
  expect_refused("absurd.ply", with(little, "face 12", "face 1000000000"),
                 "counts 1000000000 elements, but only");
  expect_refused("stop.ply", little.substr(0, little.size() - 2),
                 "the file ends before the last value");
  expect_refused("stop.ply", p.substr(0, p.size() - 6), "the file ends before the last value");
  expect_refused("index.ply", with(p, "3 0 2 3", "3 0 2 99"), "triangle 0 names point 99");
  expect_refused("list.ply", with(p, "2 -1 -2", "2000000000 -1 -2"),
                 "counts 2000000000 values of a list");
  expect_refused("none.ply", "ply\nformat ascii 1.0\nend_header\n", "holds no triangles");
}

/// What tools/make_vessel promises of a vessel along y in a box of this length: both ends of the
/// box cut the same section, and no cap is nearer to a point of the box than the wall.
void expect_periodic(const lattice::SurfaceVessel& vessel, const Vec3& box) {
  constexpr double single = 1e-5;  // spacing of single precision at 100 um
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> u(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x{box.x * u(random), 0, box.z * u(random)};
    if (vessel.distance(x) > 0) {
      EXPECT_NEAR(vessel.distance(x), vessel.distance(x + Vec3{0, box.y, 0}), single);
    }
    EXPECT_EQ(vessel.distance(x) > single, vessel.distance(x + Vec3{0, box.y, 0}) > single);
  }
}

TEST_F(SurfaceFile, TheExampleStenosisIsATubeWithAThroat) {
  const lattice::SurfaceVessel vessel(
      io::read_surface(HEMOMAG_SOURCE_DIR "/examples/stenosis.stl"));
  expect_periodic(vessel, {24, 48, 24});
  // The sides of a polygon of 56 corners are nearer to its middle than the corners.
  const double side = std::cos(std::numbers::pi / 56);
  EXPECT_NEAR(vessel.distance({12, 0, 12}), 10 * side, 1e-5);
  EXPECT_NEAR(vessel.distance({12, 48, 12}), 10 * side, 1e-5);
  EXPECT_NEAR(vessel.distance({12, 24, 12}), 6 * side, 1e-5);
  EXPECT_LT(vessel.distance({12 + 6.5, 24, 12}), 0);
  EXPECT_GT(vessel.distance({12 + 6.5, 6, 12}), 3);
}

TEST_F(SurfaceFile, TheExampleBifurcationPartsAndJoins) {
  const lattice::SurfaceVessel vessel(
      io::read_surface(HEMOMAG_SOURCE_DIR "/examples/bifurcation.stl"));
  expect_periodic(vessel, {36, 72, 18});
  // Radii by Murray's law, less what sides of 2.4 um cut off a circle: side^2 / (8 radius).
  const double daughter = 7 / std::cbrt(2.0);
  EXPECT_NEAR(vessel.distance({18, 0, 9}), 7, 2.4 * 2.4 / (8 * 7));
  EXPECT_NEAR(vessel.distance({18 - 8.5, 36, 9}), daughter, 2.4 * 2.4 / (8 * daughter));
  EXPECT_NEAR(vessel.distance({18 + 8.5, 36, 9}), daughter, 2.4 * 2.4 / (8 * daughter));
  EXPECT_LT(vessel.distance({18, 36, 9}), -2);
  EXPECT_EQ(vessel.surface().triangles.size(), 2 * vessel.surface().points.size());  // genus 1
}

TEST_F(SurfaceFile, TroubleOpeningNamesPathAndReason) {
  for (const std::string& path : {directory_ + "/absent.stl", directory_ + "/folder.stl"}) {
    if (path.ends_with("folder.stl")) io::make_directory(path);
    try {
      io::read_surface(path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find(path + ": opening failed: "), 0u) << error.what();
    }
  }
}

TEST_F(SurfaceFile, DamagedFilesAreReadOrRefused) {
  const Surface s = test::cube(1);
  std::mt19937_64 random(17);
  const std::string digits = "0123456789-+.eE \n#nai\xff";
  int refused = 0, files = 0;
  for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
           {"b.stl", stl_binary(s)},
           {"t.stl", stl_text(s)},
           {"a.off", off(s)},
           {"t.ply", ply_text(s)},
           {"l.ply", ply_binary(s, std::endian::little)},
           {"b.ply", ply_binary(s, std::endian::big)}})
    for (int i = 0; i < 400; ++i, ++files) {
      std::string damaged = bytes;
      for (auto hits = 1 + random() % 4; hits > 0; --hits)
        damaged[random() % damaged.size()] =
            random() % 2 ? digits[random() % digits.size()] : char(random());
      if (random() % 4 == 0) damaged.resize(random() % damaged.size());
      if (!refusal(name, damaged).empty()) ++refused;
    }
  EXPECT_GT(refused, files / 4);
  EXPECT_LT(refused, files);
}

}  // namespace
