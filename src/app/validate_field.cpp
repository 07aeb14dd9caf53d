#include <algorithm>
#include <cmath>
#include <limits>

#include "app/field_quadrature.hpp"
#include "app/validation.hpp"
#include "io/figure.hpp"
#include "io/files.hpp"
#include "magnetic/field.hpp"

// Magnets and coils against quadratures of their charges and currents, finite differences, and
// dipoles.

namespace hemomag::app {
namespace {

constexpr double exact = 1e-8;     // relative, of the issue
constexpr double maxwell = 1e-10;  // over the size of the gradient, of the issue
constexpr const char* name = "magnet-field";

using magnetic::BlockMagnet;
using magnetic::CurrentLoop;
using magnetic::CylinderMagnet;
using magnetic::FieldAt;
using magnetic::Frame;
using magnetic::StraightWire;

// Bodies of size one or two, turned against the axes and, but for the cylinder, against their own
// magnetisation.
const Vec3 centre{3, -2, 5}, axis{0.3, -0.5, 0.8};
const BlockMagnet block{Frame::along(centre, axis, {1, 0.2, 0}), {1.5, 1, 0.7}, {0.4, -0.3, 1.1}};
const CylinderMagnet cylinder{Frame::along(centre, axis), 1.3, 0.9, 1.2};
const CurrentLoop loop{Frame::along(centre, axis), 1.4, 2.5};
const StraightWire wire{Frame::along(centre, axis), 2.5};

/// Places around a body at least 0.4 away, on its axis, and on the planes of its faces and edges.
template <class Body> std::vector<Vec3> places(const Body& body) {
  std::vector<Vec3> all;
  const auto take = [&](const Vec3& x) {
    if (norm(body.nearest(x) - x) > 0.4) all.push_back(x);
  };
  for (const Vec3& p : {Vec3{0, 0, 2},
                        {0, 0, -3},
                        {1.5, 1, 2},
                        {3, 1, 0.7},
                        {1.5, -3, -0.7},
                        {1.3, 0, 2},
                        {3, 0, 0.9},
                        {0, -3, 0}})
    take(body.frame.place(p));
  // A lattice of irrational steps (Weyl), the same everywhere.
  for (int k = 1; k <= 120; ++k) {
    const auto share = [&](double root) { return 10 * std::fmod(k * std::sqrt(root), 1.0) - 5; };
    take(centre + Vec3{share(2), share(3), share(5)});
  }
  return all;
}

double relative(const FieldAt& a, const FieldAt& b) {
  FieldAt d = a;
  magnetic::add_scaled(d, -1, b);
  return std::max(norm(d.B) / norm(b.B), gradient_norm(d) / gradient_norm(b));
}

/// The gradient by differences of B: fourth order, step eps^(1/5) of the distance from the body.
template <class Body> FieldAt by_differences(const Body& body, const Vec3& x) {
  const double length = 0.4 * norm(body.nearest(x) - x);
  const double h = std::pow(std::numeric_limits<double>::epsilon(), 0.2) * length;
  FieldAt at{body(x).B, {}};
  for (std::size_t a = 0; a < 3; ++a) {
    Vec3 step;
    step[a] = h;
    at.gradient[a] = (8 * (body(x + step).B - body(x - step).B) -
                      (body(x + 2 * step).B - body(x - 2 * step).B)) /
                     (12 * h);
  }
  return at;
}

template <class Body>
void against_differences(const char* what, const Body& body, std::vector<Finding>& found) {
  double slope = 0, violation = 0;
  for (const Vec3& x : places(body)) {
    const FieldAt at = body(x), differences = by_differences(body, x);
    const double size = gradient_norm(at);
    slope = std::max(slope, relative(at, differences));
    violation = std::max(
        {violation, std::fabs(divergence(differences)) / size, norm(curl(differences)) / size});
  }
  found.push_back({name, std::string(what) + ", gradient against differences of B", slope, 0, exact,
                   "", "five-point differences"});
  found.push_back({name, std::string(what) + ", div B and curl B by differences, over |grad B|",
                   violation, 0, maxwell, "", "Maxwell"});
}

template <class Body>
void against_quadrature(const char* what, const Body& body, int panels,
                        std::vector<Finding>& found) {
  double worst = 0;
  for (const Vec3& x : places(body))
    worst = std::max(worst, relative(body(x), by_quadrature(body, x, panels, 16)));
  found.push_back({name, std::string(what) + ", B and gradient against a quadrature", worst, 0,
                   exact, "", "Coulomb, Biot-Savart"});
}

/// Distance from a dipole's field, whose next term is smaller by (size/r)^2: a quarter twice as
/// far.
template <class Body>
void against_dipole(const char* what, const Body& body, const Vec3& m,
                    std::vector<Finding>& found) {
  const auto error = [&](double distance) {
    double worst = 0;
    for (const Vec3& x : places(body)) {
      const Vec3 e = (x - centre) / norm(x - centre), r = distance * e;
      const Vec3 B = (3 * dot(m, e) * e - m) / (4 * std::numbers::pi * std::pow(distance, 3));
      worst = std::max(worst, norm(body(centre + r).B - B) / norm(B));
    }
    return worst;
  };
  const double near = error(50), far = error(100);
  found.push_back(printed(name, std::string(what) + ", difference from a dipole at 100", far, 0, "",
                          "m = J V/mu*, I A"));
  found.push_back({name, std::string(what) + ", difference from a dipole, at 50 over at 100",
                   near / far, 4, 0.1, "", "falls with 1/r^2"});
}

// The figure: a cylinder of NdFeB and a pair of coils with opposite currents, in millimetres.

const CylinderMagnet drawn_magnet{{}, 2.5, 2.5, 1.3};
constexpr double mu = 1.25663706212e-6;
constexpr double ampere_turns = 1000;  // of each coil
constexpr double half_distance = 2.5;  // mm
const CurrentLoop coil_behind{{{0, 0, -half_distance}}, 5, -ampere_turns* mu * 1e3};
const CurrentLoop coil_ahead{{{0, 0, half_distance}}, 5, ampere_turns* mu * 1e3};

/// A field line in the plane y = 0 from a place on, as far as it stays in the picture and out of
/// what `inside` says.
template <class Field, class Inside>
io::Series field_line(const Field& B, Inside inside, Vec3 x, double sign, double half_x,
                      double half_z) {
  io::Series line{"", "#1f77b4", {}, {}, {}, io::Series::Style::line};
  constexpr double step = 0.04;
  const auto direction = [&](const Vec3& at) {
    Vec3 b = B(at);
    b.y = 0;
    return sign / std::max(norm(b), 1e-12) * b;
  };
  for (int k = 0; k < 1500; ++k) {
    line.x.push_back(x.x), line.y.push_back(x.z);
    x += step * direction(x + 0.5 * step * direction(x));
    if (std::fabs(x.x) > half_x || std::fabs(x.z) > half_z || inside(x)) break;
  }
  return line;
}

io::Diagram magnet_lines() {
  io::Diagram d{"cylinder magnet, 5 mm wide and long: field lines",
                "x (mm)",
                "z (mm)",
                {},
                {-12, 12},
                {-9, 9}};
  const auto B = [](const Vec3& x) { return drawn_magnet(x).B; };
  const auto inside = [](const Vec3& x) { return norm(drawn_magnet.nearest(x) - x) < 1e-9; };
  for (double x = -2.4; x <= 2.41; x += 0.3)
    for (const double z : {2.52, -2.52})
      d.series.push_back(field_line(B, inside, {x, 0, z}, z > 0 ? 1 : -1, 12, 9));
  d.series.push_back({"",
                      "#c0392b",
                      {-2.5, 2.5, 2.5, -2.5, -2.5},
                      {-2.5, -2.5, 2.5, 2.5, -2.5},
                      {},
                      io::Series::Style::line});
  return d;
}

io::Diagram coil_lines() {
  io::Diagram d{
      "two coils, opposite currents: field lines", "x (mm)", "z (mm)", {}, {-12, 12}, {-9, 9}};
  const auto B = [](const Vec3& x) { return coil_behind(x).B + coil_ahead(x).B; };
  const auto nowhere = [](const Vec3&) { return false; };
  for (double x = -4.5; x <= 4.51; x += 0.75)
    for (const double z : {2.5, -2.5})
      for (const double sign : {1.0, -1.0})
        d.series.push_back(field_line(B, nowhere, {x, 0, z}, sign, 12, 9));
  for (const double x : {-5.0, 5.0})
    d.series.push_back(
        {"", "#c0392b", {x, x}, {-half_distance, half_distance}, {}, io::Series::Style::dots});
  return d;
}

/// Bz on the axis: the closed form, and the quadrature at some places.
io::Diagram on_axis(io::CsvFile& csv) {
  using enum io::Series::Style;
  io::Diagram d{"on the axis", "z (mm)", "Bz (T)", {}, {0, 15}, {0, 0.7}};
  io::Series magnet{"magnet", "#1f77b4", {}, {}, {}, line},
      coils{"coils, x 5", "#2ca02c", {}, {}, {}, line};
  io::Series sums{"quadrature", "black", {}, {}, {}, circles};
  for (int k = 0; k <= 150; ++k) {
    const Vec3 x{0, 0, 0.1 * k};
    const bool outside = x.z > 2.5;
    const double coil = coil_behind(x).B.z + coil_ahead(x).B.z;
    coils.x.push_back(x.z), coils.y.push_back(5 * coil);
    if (outside) {
      magnet.x.push_back(x.z), magnet.y.push_back(drawn_magnet(x).B.z);
      csv.row({x.z, magnet.y.back(), coil});
    }
    if (k % 10 != 5) continue;
    sums.x.push_back(x.z);
    sums.y.push_back(
        5 * (by_quadrature(coil_behind, x, 8, 16).B.z + by_quadrature(coil_ahead, x, 8, 16).B.z));
    if (!outside) continue;
    sums.x.push_back(x.z);
    sums.y.push_back(by_quadrature(drawn_magnet, x, 4, 16).B.z);
  }
  d.series = {magnet, coils, sums};
  return d;
}

void draw(const std::string& out) {
  io::make_directory(out);
  io::CsvFile csv(out + "/magnet-field.csv", "z_mm,Bz_magnet_T,Bz_coils_T");
  io::replace_file(out + "/magnet-field.svg",
                   io::draw_diagrams({magnet_lines(), coil_lines(), on_axis(csv)}));
}

std::vector<Finding> magnet_field(const std::string& out) {
  draw(out);
  std::vector<Finding> found;
  against_quadrature("block", block, 4, found);
  against_quadrature("cylinder", cylinder, 4, found);
  against_quadrature("loop", loop, 16, found);
  against_differences("block", block, found);
  against_differences("cylinder", cylinder, found);
  against_differences("loop", loop, found);
  against_differences("wire", wire, found);
  const double pi = std::numbers::pi;
  against_dipole(
      "block", block,
      8 * block.half.x * block.half.y * block.half.z * block.frame.vector(block.remanence), found);
  against_dipole("cylinder", cylinder,
                 cylinder.remanence * pi * cylinder.radius * cylinder.radius * 2 * cylinder.half *
                     cylinder.frame.axes[2],
                 found);
  against_dipole("loop", loop, loop.current * pi * loop.radius * loop.radius * loop.frame.axes[2],
                 found);
  return found;
}

}  // namespace

std::vector<Validation> field_validations() {
  return {{name, "fields of magnets and coils against quadratures, differences and dipoles",
           magnet_field}};
}

}  // namespace hemomag::app
