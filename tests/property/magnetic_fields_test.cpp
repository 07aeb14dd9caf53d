// External fields: exact gradients, Maxwell's equations, time factors, and the grammar they are
// written in.
#include <gtest/gtest.h>

#include <sstream>

#include "app/field_quadrature.hpp"
#include "base/error.hpp"
#include "magnetic/clearance.hpp"
#include "magnetic/field_words.hpp"
#include "magnetic/moment.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;
using test::Random;

std::shared_ptr<const lattice::FieldTable> no_tables(const std::string& file) {
  throw Error(file + " is not read here");
}

magnetic::Field field_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  magnetic::Field field;
  for (std::size_t at = 0; at < words.size();) magnetic::read_source(words, at, field, no_tables);
  return field;
}

/// Largest difference of the gradient and a five-point difference over its largest entry.
double gradient_error(const magnetic::Field& field, const Vec3& x, double length) {
  const auto at = field(x);
  double worst = 0;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const double slope = test::slope_at_zero(length, [&](double h) {
        Vec3 y = x;
        y[a] += h;
        return field(y).B[b];
      });
      worst = std::max(worst, std::fabs(slope - at.gradient[a][b]));
    }
  return worst / (magnetic::gradient_norm(at) + 1e-300);
}

TEST(PlainFields, GradientsEqualFiniteDifferences) {
  Random random(7);
  EXPECT_EQ(magnetic::gradient_norm(field_of("uniform 1 2 3")({4, 5, 6})), 0);
  for (const char* text : {"gradient x 0.3 4", "gradient z -0.7 20", "quadrupole zx 0.3 1 2 3"})
    for (int k = 0; k < 100; ++k)
      EXPECT_LT(gradient_error(field_of(text), random.in_cube(10), 10), 1e-8) << text;
}

TEST(PlainFields, TheQuadrupoleObeysMaxwellAndTheModelOfOneAxisDoesNot) {
  const auto four = field_of("quadrupole yz 0.3 1 2 3")({7, -2, 5});
  EXPECT_EQ(magnetic::divergence(four), 0);
  EXPECT_EQ(norm(magnetic::curl(four)), 0);
  EXPECT_NEAR(norm(four.B), 0.3 * std::hypot(-4, 2), 1e-15);
  EXPECT_EQ(magnetic::divergence(field_of("gradient z 0.3 0")({1, 1, 1})), 0.3);
}

TEST(TimeFactors, ARotatingFieldTurnsFromTheFirstAxisToTheSecond) {
  auto field = field_of("rotating zx 0.5 0.01");
  for (const double t : {0.0, 7.0, 25.0, 1e7 + 12.5}) {
    field.set_time(t);
    const double angle = 2 * std::numbers::pi * std::fmod(0.01 * t, 1.0);
    const Vec3 expected{0.5 * std::sin(angle), 0, 0.5 * std::cos(angle)};
    EXPECT_LT(norm(field({1, 2, 3}).B - expected), 1e-9) << t;
  }
}

TEST(TimeFactors, SineRampAndPulse) {
  const auto at = [](const char* factor, double t) {
    auto field = field_of(std::string("uniform 0 0 2 ") + factor);
    field.set_time(t);
    return field({}).B.z;
  };
  EXPECT_NEAR(at("sine 0.02", 5), 2 * std::sin(0.2 * std::numbers::pi), 1e-14);
  EXPECT_EQ(at("ramp 10 20", 9), 0);
  EXPECT_EQ(at("ramp 10 20", 15), 0.5);
  EXPECT_EQ(at("ramp 10 20", 40), 2);
  EXPECT_EQ(at("pulse 10 20", 9.9), 0);
  EXPECT_EQ(at("pulse 10 20", 10), 2);
  EXPECT_EQ(at("pulse 10 20", 30), 0);
  EXPECT_NEAR(at("sine 0.02 ramp 0 10", 5), std::sin(0.2 * std::numbers::pi), 1e-14);
}

TEST(FieldWords, ASumIsASum) {
  auto field = field_of("gradient z 0.1 0 uniform 1 0 0 pulse 5 5 quadrupole xy 0.2 0 0 0");
  EXPECT_LT(norm(field({1, 2, 3}).B - Vec3{0.2, -0.4, 0.3}), 1e-15);
  field.set_time(6);
  EXPECT_LT(norm(field({1, 2, 3}).B - Vec3{1.2, -0.4, 0.3}), 1e-15);
}

TEST(FieldWords, RefuseWhatTheyDoNotKnow) {
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
           {"unifrom 1 2 3", "accepted: none, uniform"},
           {"uniform 1 2", "ends before BZ"},
           {"uniform 1 2 z", "not a number"},
           {"uniform 1 2 nan", "not a number"},
           {"gradient w 1 2", "accepted: x, y, z"},
           {"quadrupole xx 1 0 0 0", "not a plane"},
           {"rotating xy 1", "ends before FREQUENCY"},
           {"rotating xy 1 0.1 sine 0.2", "oscillates already"},
           {"uniform 1 2 3 ramp 0 0", "above 0"},
           {"uniform 1 2 3 ramp 0 1 pulse 0 1", "exclude each other"}}) {
    try {
      field_of(text);
      FAIL() << text;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  }
}

/// Largest difference of two fields over their size, and of their gradients over theirs.
double difference(const magnetic::FieldAt& a, const magnetic::FieldAt& b) {
  magnetic::FieldAt d = a;
  magnetic::add_scaled(d, -1, b);
  return std::max(norm(d.B) / norm(b.B), magnetic::gradient_norm(d) / magnetic::gradient_norm(b));
}

const Vec3 centre{3, -2, 5}, axis{0.3, -0.5, 0.8}, across{1, 0.2, 0};

magnetic::BlockMagnet tilted_block() {
  const auto frame = magnetic::Frame::along(centre, axis, across);
  return {frame, {1.5, 1, 0.7}, {0.4, -0.3, 1.1}};
}
magnetic::CylinderMagnet tilted_cylinder() {
  return {magnetic::Frame::along(centre, axis), 1.3, 0.9, 1.2};
}
magnetic::CurrentLoop tilted_loop() { return {magnetic::Frame::along(centre, axis), 1.4, 2.5}; }
magnetic::StraightWire tilted_wire() { return {magnetic::Frame::along(centre, axis), 2.5}; }

/// Places about a body of size one or two: at random, and where a closed form may fail: on the
/// axis, on the planes of faces, on the extensions of edges and of the side.
template <class Body> std::vector<Vec3> places(const Body& body, const std::vector<Vec3>& special) {
  Random random(11);
  std::vector<Vec3> all;
  for (const Vec3& p : special) {
    all.push_back(body.frame.place(p));
    all.push_back(body.frame.place(p + random.in_cube(1e-9)));
    all.push_back(body.frame.place(p + random.in_cube(1e-5)));
  }
  while (all.size() < 3 * special.size() + 60) {
    const Vec3 x = centre + random.in_cube(5);
    if (norm(body.nearest(x) - x) > 0.4) all.push_back(x);
  }
  return all;
}

const std::vector<Vec3> about_block{{0, 0, 2},   {1.5, 0, 2}, {1.5, 1, 2},    {1.5, 1, -2},
                                    {3, 0, 0.7}, {3, 1, 0.7}, {-3, -1, -0.7}, {1.5, -3, -0.7},
                                    {1.5, 3, 0}, {0, 2.5, 0}, {3, 0, 0},      {2, 1, 0.2}};
const std::vector<Vec3> about_round{{0, 0, 2},      {0, 0, -3},  {1.3, 0, 2},
                                    {0, 1.3, -2.5}, {3, 0, 0.9}, {0, 3, -0.9},
                                    {-2.5, 0, 0},   {1.4, 0, 2}, {0.1, 0, 2}};

TEST(Magnets, EqualTheQuadratureOfTheirCharges) {
  double worst = 0;
  for (const Vec3& x : places(tilted_block(), about_block))
    worst = std::max(worst,
                     difference(tilted_block()(x), app::by_quadrature(tilted_block(), x, 4, 16)));
  EXPECT_LT(worst, 1e-8) << "block";
  std::printf("block %.1e\n", worst);
  worst = 0;
  for (const Vec3& x : places(tilted_cylinder(), about_round))
    worst = std::max(
        worst, difference(tilted_cylinder()(x), app::by_quadrature(tilted_cylinder(), x, 4, 16)));
  EXPECT_LT(worst, 1e-8) << "cylinder";
  std::printf("cylinder %.1e\n", worst);
}

TEST(Coils, EqualTheQuadratureOfTheirCurrent) {
  double worst = 0;
  for (const Vec3& x : places(tilted_loop(), about_round))
    worst =
        std::max(worst, difference(tilted_loop()(x), app::by_quadrature(tilted_loop(), x, 16, 16)));
  EXPECT_LT(worst, 1e-8);
  std::printf("loop %.1e\n", worst);
}

TEST(Coils, OnTheAxisTheFieldIsKnown) {
  const magnetic::CurrentLoop loop{{}, 1.5, 2};
  for (const double z : {-3.0, 0.0, 0.2, 7.0})
    EXPECT_NEAR(loop({0, 0, z}).B.z, 2 * 1.5 * 1.5 / (2 * std::pow(1.5 * 1.5 + z * z, 1.5)), 1e-15);
  const magnetic::CylinderMagnet magnet{{}, 1.5, 2, 1.1};
  for (const double z : {-3.0, 2.5, 7.0}) {
    const auto end = [&](double h) { return h / std::hypot(h, 1.5); };
    EXPECT_NEAR(magnet({0, 0, z}).B.z, 0.55 * (end(z + 2) - end(z - 2)), 1e-15);
  }
  // Helmholtz: the second derivative vanishes in the middle of a pair a radius apart.
  const auto pair = field_of("coil_pair 1 1 2 1 0 0 0 0 0 1");
  const double middle = pair({}).B.z;
  EXPECT_NEAR(middle, std::pow(0.8, 1.5), 1e-15);
  EXPECT_NEAR(pair({0, 0, 1e-2}).B.z, middle, 2e-8 * middle);
  const auto opposed = field_of("coil_pair -1 1 2 1 0 0 0 0 0 1");
  EXPECT_NEAR(opposed({}).B.z, 0, 1e-16);
  EXPECT_GT(opposed({}).gradient[2].z, 0.1);
}

template <class Body>
void expect_exact(const Body& body, const std::vector<Vec3>& special, const char* name) {
  const magnetic::Field field({{body, {}}});
  double slope = 0, div = 0, rot = 0;
  for (const Vec3& x : places(body, special)) {
    const auto at = field(x);
    slope = std::max(slope, gradient_error(field, x, 0.4 * norm(body.nearest(x) - x)));
    div = std::max(div, std::fabs(magnetic::divergence(at)) / magnetic::gradient_norm(at));
    rot = std::max(rot, norm(magnetic::curl(at)) / magnetic::gradient_norm(at));
  }
  std::printf("%s: gradient %.1e, div %.1e, curl %.1e\n", name, slope, div, rot);
  EXPECT_LT(slope, 1e-8) << name;
  EXPECT_LT(div, 1e-10) << name;
  EXPECT_LT(rot, 1e-10) << name;
}

TEST(Bodies, GradientsEqualFiniteDifferencesAndObeyMaxwell) {
  expect_exact(tilted_block(), about_block, "block");
  expect_exact(tilted_cylinder(), about_round, "cylinder");
  expect_exact(tilted_loop(), about_round, "loop");
  expect_exact(tilted_wire(), {{3, 0, 0}, {0, -3, 2}}, "wire");
}

TEST(Bodies, FarAwayAreDipoles) {
  // mu* m = J V or I A; B = (3 (m.e) e - m)/(4 pi r^3), the next term is smaller by (size/r)^2.
  const auto dipole = [](const Vec3& m, const Vec3& r) {
    const double d = norm(r);
    const Vec3 e = r / d;
    return (3 * dot(m, e) * e - m) / (4 * std::numbers::pi * d * d * d);
  };
  const auto error = [&](const auto& body, const Vec3& m, double distance) {
    double worst = 0;
    Random random(3);
    for (int k = 0; k < 40; ++k) {
      Vec3 e = random.in_cube(1);
      const Vec3 r = distance / norm(e) * e, expected = dipole(m, r);
      worst = std::max(worst, norm(body(centre + r).B - expected) / norm(expected));
    }
    return worst;
  };
  const auto block = tilted_block();
  const auto cylinder = tilted_cylinder();
  const auto loop = tilted_loop();
  const double pi = std::numbers::pi;
  const Vec3 block_m =
      8 * block.half.x * block.half.y * block.half.z * block.frame.vector(block.remanence);
  const Vec3 cylinder_m = cylinder.remanence * pi * std::pow(cylinder.radius, 2) * 2 *
                          cylinder.half * cylinder.frame.axes[2];
  const Vec3 loop_m = loop.current * pi * loop.radius * loop.radius * loop.frame.axes[2];
  const auto expect_dipole = [&](const auto& body, const Vec3& m, const char* name) {
    const double near = error(body, m, 50), far = error(body, m, 100);
    std::printf("%s: %.1e at 50, %.1e at 100\n", name, near, far);
    EXPECT_LT(near, 4e-3) << name;
    EXPECT_NEAR(near / far, 4, 0.05) << name;
  };
  expect_dipole(block, block_m, "block");
  expect_dipole(cylinder, cylinder_m, "cylinder");
  expect_dipole(loop, loop_m, "loop");
}

TEST(Bodies, TheirDistanceFromABoxIsKnown) {
  const Vec3 low{0, 0, 0}, high{4, 6, 2};
  const auto distance = [&](const auto& body) { return magnetic::gap(body, low, high)->distance; };
  const magnetic::Frame below{{2, 3, -2}};
  EXPECT_NEAR(distance(magnetic::BlockMagnet{below, {1, 1, 1}, {}}), 1, 1e-12);
  EXPECT_NEAR(distance(magnetic::CylinderMagnet{below, 9, 1, 1}), 1, 1e-12);
  EXPECT_EQ(distance(magnetic::BlockMagnet{below, {1, 1, 2.5}, {}}), 0);
  EXPECT_EQ(distance(magnetic::BlockMagnet{{{2, 3, 1}}, {0.1, 0.1, 0.1}, {}}), 0) << "inside";
  // An edge toward the box: 4 beside it, half a diagonal of the block away.
  const auto turned = magnetic::Frame::along({8, 3, 1}, {1, 0, 1}, {1, 0, -1});
  EXPECT_NEAR(distance(magnetic::BlockMagnet{turned, {1, 1, 1}, {}}), 4 - std::sqrt(2), 1e-12);
  // A coil around the channel, and one that cuts it.
  const auto around = magnetic::Frame::along({2, 3, 1}, {0, 1, 0});
  EXPECT_NEAR(distance(magnetic::CurrentLoop{around, 5, 1}), 5 - std::hypot(2, 1), 1e-6);
  EXPECT_LT(distance(magnetic::CurrentLoop{around, 1.5, 1}), 1e-9);
  const auto wire = magnetic::Frame::along({2, 3, 3.5}, {1, 1, 0});
  EXPECT_NEAR(distance(magnetic::StraightWire{wire, 1}), 1.5, 1e-12);
  EXPECT_FALSE(magnetic::gap(magnetic::UniformField{}, low, high).has_value());
}

/// A table of a field on a grid of n points along each axis of the box -1 ... 1.
template <class Body> lattice::FieldTable tabulated(const Body& body, std::size_t n) {
  lattice::FieldTable table;
  table.n = {n, n + 1, n + 2};
  table.first = {-1, -1, -1};
  for (std::size_t a = 0; a < 3; ++a) table.spacing[a] = 2.0 / static_cast<double>(table.n[a] - 1);
  for (std::size_t k = 0; k < n + 2; ++k)
    for (std::size_t j = 0; j < n + 1; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3 index{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        Vec3 x = table.first;
        for (std::size_t a = 0; a < 3; ++a) x[a] += index[a] * table.spacing[a];
        table.B.push_back(body(x).B);
      }
  return table;
}

TEST(Tables, ReproduceCubicPolynomialsExactly) {
  const auto cubic = [](const Vec3& x) {
    return magnetic::FieldAt{{x.x * x.x * x.y - 2 * x.z, x.y * x.y * x.y + x.x * x.z * x.z,
                              1 + x.z * x.z * x.z * x.x * x.y},
                             {}};
  };
  Random random(5);
  for (const std::size_t n : {4u, 5u, 6u, 9u}) {
    const magnetic::TableField field(tabulated(cubic, n), {}, 1, 1);
    for (int k = 0; k < 100; ++k) {
      const Vec3 x = random.in_cube(1.1);
      EXPECT_LT(norm(field(x).B - cubic(x).B), 1e-13) << n;
    }
  }
}

TEST(Tables, AreOfFourthOrderInBAndThirdInItsGradient) {
  const magnetic::BlockMagnet magnet{
      magnetic::Frame::along({0.3, 0.2, -4}, axis, across), {1, 1, 0.8}, {0.2, 0, 1}};
  double B_before = 0, slope_before = 0;
  for (const std::size_t n : {17u, 33u, 65u}) {
    const magnetic::TableField field(tabulated(magnet, n), {}, 1, 1);
    Random random(6);
    double B = 0, slope = 0, B_scale = 0, scale = 0, div = 0, rot = 0;
    for (int k = 0; k < 2000; ++k) {
      const Vec3 x = random.in_cube(1);
      const auto at = field(x), exact = magnet(x);
      magnetic::FieldAt d = at;
      magnetic::add_scaled(d, -1, exact);
      B = std::max(B, norm(d.B)), slope = std::max(slope, magnetic::gradient_norm(d));
      B_scale = std::max(B_scale, norm(exact.B)),
      scale = std::max(scale, magnetic::gradient_norm(exact));
      div = std::max(div, std::fabs(magnetic::divergence(at)));
      rot = std::max(rot, norm(magnetic::curl(at)));
    }
    std::printf("%zu points: B %.1e, gradient %.1e, div %.1e, curl %.1e of the largest\n", n,
                B / B_scale, slope / scale, div / scale, rot / scale);
    if (n == 65) {
      EXPECT_GT(B_before / B, 13) << "16 in fourth order";
      EXPECT_GT(slope_before / slope, 6.5) << "8 in third order";
      EXPECT_LT(slope / scale, 1e-3);
      EXPECT_LT(div / scale, 1e-3);
      EXPECT_LT(rot / scale, 1e-3);
    }
    B_before = B, slope_before = slope;
  }
}

TEST(Tables, HaveAGradientThatIsTheirOwnAndContinuousAcrossCells) {
  const magnetic::BlockMagnet magnet{
      magnetic::Frame::along({0.3, 0.2, -4}, axis, across), {1, 1, 0.8}, {0.2, 0, 1}};
  const lattice::FieldTable table = tabulated(magnet, 9);
  const magnetic::TableField spline(table, {}, 1, 1);
  const magnetic::Field field({{spline, {}}});
  Random random(9);
  double jump = 0, own = 0;
  for (int k = 0; k < 300; ++k) {
    Vec3 x = random.in_cube(0.9);
    own = std::max(own, gradient_error(field, x, 0.05));
    for (std::size_t a = 0; a < 3; ++a) {
      Vec3 left = x;
      left[a] = table.first[a] +
                std::floor((x[a] - table.first[a]) / table.spacing[a]) * table.spacing[a];
      Vec3 right = left;
      left[a] -= 1e-12, right[a] += 1e-12;
      magnetic::FieldAt d = spline(left);
      magnetic::add_scaled(d, -1, spline(right));
      jump = std::max(
          {jump, magnetic::gradient_norm(d) / magnetic::gradient_norm(spline(x)), norm(d.B)});
    }
  }
  EXPECT_LT(jump, 1e-10) << "2e-12 apart";
  EXPECT_LT(own, 1e-8);
}

TEST(Tables, TakeTheirUnitsAndTheirOrigin) {
  const magnetic::AxialGradient slope{0, 3, 0};
  const magnetic::TableField field(tabulated(slope, 5), {10, 20, 30}, 2, 0.5);
  EXPECT_NEAR(field({11, 20, 30}).B.x, 0.5 * 3 * 0.5, 1e-14);
  EXPECT_NEAR(field({11, 20, 30}).gradient[0].x, 0.5 * 3 / 2, 1e-14);
  EXPECT_TRUE(magnetic::covers(field, {8, 18, 28}, {12, 22, 32}));
  EXPECT_FALSE(magnetic::covers(field, {8, 18, 28}, {12, 22, 32.1}));
}

TEST(Moments, AreLinearInWeakFieldsAndSaturateInStrongOnes) {
  const magnetic::Magnetisation law{0.4, 2.5};
  const Vec3 e{0.6, 0, 0.8};
  for (const double B : {1e-6, 1e-3}) {
    const Vec3 m = law.moment(B * e);
    const double xi = 3 * 0.4 * B / 2.5;
    EXPECT_NEAR(norm(m) / (0.4 * B), 1 - xi * xi / 15, 1e-13);
    EXPECT_LT(norm(m - norm(m) * e), 1e-16);
  }
  for (const double B : {200.0, 1e4})
    EXPECT_NEAR(norm(law.moment(B * e)), 2.5 * (1 - 2.5 / (1.2 * B)), 1e-14);
  const double xi = 1.7;
  EXPECT_NEAR(norm(law.moment(xi * 2.5 / 1.2 * e)), 2.5 * (1 / std::tanh(xi) - 1 / xi), 1e-14);
  // No step where the series ends, in the moment and in the energy.
  const double edge = 0.2 * 2.5 / 1.2;
  EXPECT_NEAR(norm(law.moment(edge * (1 - 1e-13) * e)), norm(law.moment(edge * (1 + 1e-13) * e)),
              1e-13);
  EXPECT_NEAR(law.energy(edge * (1 - 1e-13) * e), law.energy(edge * (1 + 1e-13) * e), 1e-13);
  const magnetic::Magnetisation linear{0.4};
  EXPECT_NEAR(norm(linear.moment(7 * e)), 2.8, 1e-15);
}

TEST(Moments, EnergyIsMinusTheIntegralOfTheMoment) {
  for (const double saturation : {0.0, 0.05, 0.5, 5.0}) {
    const magnetic::Magnetisation law{0.4, saturation};
    double sum = 0;
    for (const auto& B : app::gauss_legendre(0, 2, 40, 12))
      sum -= B.weight * law.moment({0, 0, B.x}).z;
    EXPECT_NEAR(law.energy({0, 0, 2}), sum, 1e-12) << saturation;
  }
}

TEST(Moments, ForceIsMinusTheGradientOfTheirEnergyWhereCurlVanishes) {
  const magnetic::Field fields[] = {
      field_of("gradient z 0.4 10"), field_of("quadrupole zx 0.3 9 9 9"),
      magnetic::Field({{tilted_block(), {}}}), magnetic::Field({{tilted_cylinder(), {}}}),
      magnetic::Field({{tilted_loop(), {}}, {tilted_wire(), {}}})};
  Random random(8);
  double worst = 0;
  for (const auto& field : fields)
    for (const double saturation : {0.0, 0.003, 0.05})
      for (int k = 0; k < 40; ++k) {
        const std::vector<Vec3> x{centre + 4 / norm(axis) * axis + random.in_cube(1.2)};
        const magnetic::Magnetisation law{0.1, saturation};
        const auto at = field(x[0]);
        const Vec3 F = magnetic::gradient_force(law.moment(at.B), at);
        worst =
            std::max(worst, test::gradient_error(x, std::vector<Vec3>{F}, 0.5, [&](const auto& y) {
                       return law.energy(field(y[0]).B);
                     }));
      }
  EXPECT_LT(worst, 1e-7);
}

}  // namespace
