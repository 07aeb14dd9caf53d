// Fields of a case: SI to lattice units through the words of the script, and what the card makes of
// them.
#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "case/card.hpp"
#include "case/external_field.hpp"
#include "case/lattice_units.hpp"
#include "magnetic/moment.hpp"

namespace {

using namespace hemomag;
using namespace hemomag::case_;

constexpr double pi = std::numbers::pi, mu = vacuum_permeability;

/// A box of 27 x 36 x 24 um at dx = 0.5 um with carriers of 125 nm, and one source.
Case with(const MagneticSource& source) {
  Case c;
  c.channel.size = {27e-6, 36e-6, 24e-6};
  c.channel.shear_rate = 200;
  c.fluid.viscosity = 1.2e-3;
  c.numerics.dx = 0.5e-6;
  c.numerics.cell_reynolds = 0.5;
  c.run.time = 0.1;
  c.carriers.emplace_back();
  c.carriers[0].radius = 125e-9;
  c.carriers[0].count = 80;
  c.magnetic.dipoles = false;
  c.magnetic.sources = {source};
  return c;
}

/// The field of the run at a place [m] and time [s], in tesla and tesla a metre.
magnetic::FieldAt at(const Case& c, Vec3 x, double t = 0) {
  const LatticeUnits units = lattice_units(c);
  magnetic::Field field = external_field(c);
  field.set_time(t / units.dt);
  magnetic::FieldAt value = field(x / units.dx);
  value.B *= units.magnetic_field();
  for (Vec3& slope : value.gradient) slope *= units.magnetic_field() / units.dx;
  return value;
}

const CardLine* line(const Card& card, const std::string& name) {
  const auto found = std::find_if(card.lines.begin(), card.lines.end(),
                                  [&](const CardLine& l) { return l.name == name; });
  return found == card.lines.end() ? nullptr : &*found;
}

MagneticSource source_of(FieldKind kind) {
  MagneticSource s;
  s.field = kind;
  return s;
}

MagneticSource rod(double z) {
  MagneticSource s = source_of(FieldKind::magnet);
  s.shape = MagnetShape::cylinder;
  s.position = {13e-6, 18e-6, z};
  s.diameter = 4e-3, s.length = 6e-3, s.remanence = 1.3;
  return s;
}

TEST(ExternalField, AMagnetHasItsFieldInTesla) {
  const Case c = with(rod(-3.1e-3));  // its end is 100 um under the box
  const auto end = [](double h) { return h / std::hypot(h, 2e-3); };
  const double B = 0.65 * (end(6.1e-3) - end(0.1e-3));
  EXPECT_NEAR(at(c, {13e-6, 18e-6, 0}).B.z, B, 1e-10);
  MagneticSource block = rod(-3.1e-3);
  block.shape = MagnetShape::block;
  block.size = {4e-3, 4e-3, 6e-3};
  // 4 arctan(a^2/(h sqrt(h^2 + 2 a^2))) over 4 pi at each end.
  const auto angle = [](double h) { return std::atan(4e-6 / (h * std::sqrt(h * h + 8e-6))); };
  EXPECT_NEAR(at(with(block), {13e-6, 18e-6, 0}).B.z, 1.3 / pi * (angle(0.1e-3) - angle(6.1e-3)),
              1e-10);
}

TEST(ExternalField, CoilsAndWiresHaveTheirFieldInTesla) {
  MagneticSource coil = source_of(FieldKind::coil);
  coil.position = {13e-6, 18e-6, 12e-6};
  coil.axis = {0, 1, 0};
  coil.diameter = 2e-3, coil.current = 3 * 50;  // 50 turns
  EXPECT_NEAR(at(with(coil), {13e-6, 18e-6, 12e-6}).B.y, mu * 150 / 2e-3, 1e-11);
  coil.pair = CoilPair::same, coil.distance = 1e-3;  // Helmholtz
  EXPECT_NEAR(at(with(coil), {13e-6, 18e-6, 12e-6}).B.y, std::pow(0.8, 1.5) * mu * 150 / 1e-3,
              1e-11);
  MagneticSource wire = source_of(FieldKind::wire);
  wire.position = {13e-6, 0, -1e-4};
  wire.axis = {0, 1, 0};
  wire.current = 2;
  EXPECT_NEAR(at(with(wire), {13e-6, 5e-6, 0}).B.x, mu * 2 / (2 * pi * 1e-4), 1e-11);
  EXPECT_NEAR(at(with(wire), {13e-6, 5e-6, 0}).gradient[2].x, -mu * 2 / (2 * pi * 1e-8), 1e-7);
}

TEST(ExternalField, ATableIsInMetresAndTesla) {
  lattice::FieldTable table{{4, 4, 4}, {-1e-5, -1e-5, -1e-5}, {2e-5, 2e-5, 2e-5}, {}};
  for (int k = 0; k < 64; ++k) table.B.push_back({0, 0, 100 * 2e-5 * (k / 16)});
  MagneticSource s = source_of(FieldKind::table);
  s.file = "B.csv";
  s.table = std::make_shared<const lattice::FieldTable>(table);
  const auto value = at(with(s), {1e-6, 2e-6, 3e-6});
  EXPECT_NEAR(value.B.z, 100 * 1.3e-5, 1e-13);
  EXPECT_NEAR(value.gradient[2].z, 100, 1e-8);
  EXPECT_FALSE(make_card(with(s), {}).refused());
  s.position = {0, 0, 2e-5};
  EXPECT_TRUE(make_card(with(s), {}).refused()) << "begins above the lower plate";
}

TEST(ExternalField, TimeIsInSeconds) {
  MagneticSource s = source_of(FieldKind::rotating);
  s.B0 = 0.01, s.frequency = 20, s.plane = "zx";
  EXPECT_NEAR(at(with(s), {}, 1.0 / 80).B.x, 0.01, 1e-12);
  EXPECT_NEAR(at(with(s), {}, 1.0 / 40).B.z, -0.01, 1e-12);
  MagneticSource ramp = source_of(FieldKind::quadrupole);
  ramp.gradient = 500;
  ramp.plane = "zx";
  ramp.time = TimeCourse::ramp, ramp.start = 0.02, ramp.duration = 0.04;
  EXPECT_NEAR(at(with(ramp), {4e-6, 0, 6e-6}, 0.05).B.z, 0.75 * 500 * 6e-6, 1e-12);
}

TEST(FieldCard, SaysWhatTheModelOfThePaperDoes) {
  MagneticSource s = source_of(FieldKind::gradient);
  s.B0 = 0.1;
  const Card card = make_card(with(s), {});
  EXPECT_EQ(line(card, "largest field")->value, "0.1 T");
  EXPECT_EQ(line(card, "largest field gradient")->value, "4167 T/m");
  EXPECT_EQ(line(card, "largest pull")->value, "0.651 pN") << "tabulated";
  EXPECT_EQ(line(card, "div B")->verdict, Verdict::note);
  EXPECT_EQ(line(card, "curl B"), nullptr);
  EXPECT_FALSE(card.refused()) << "it runs, with a note";
}

TEST(FieldCard, NamesNoViolationOfTrueFields) {
  MagneticSource s = source_of(FieldKind::quadrupole);
  s.gradient = 4000;
  for (const MagneticSource& source : {rod(-3.1e-3), s}) {
    const Card card = make_card(with(source), {});
    EXPECT_EQ(line(card, "div B"), nullptr);
    EXPECT_EQ(line(card, "curl B"), nullptr);
    EXPECT_FALSE(card.refused());
  }
}

TEST(FieldCard, RefusesADriftBeyondTheMethodOfAnyField) {
  MagneticSource wire = source_of(FieldKind::wire);
  wire.position = {13e-6, 18e-6, -1e-6};
  wire.axis = {0, 1, 0};
  wire.current = 0.01;
  EXPECT_FALSE(make_card(with(wire), {}).refused());
  wire.current = 3;
  const Card card = make_card(with(wire), {});
  EXPECT_EQ(line(card, "drift")->verdict, Verdict::refused);
  // The strongest pull is where the wire is nearest, between the points of the grid.
  const double B = mu * 3 / (2 * pi * 1e-6), slope = B / 1e-6;
  const double force = susceptible_volume(with(wire).carriers[0]) * B * slope / mu;
  EXPECT_NEAR(std::stod(line(card, "largest pull")->value), force * 1e12, 1e-3 * force * 1e12);
  EXPECT_NEAR(std::stod(line(card, "largest field")->value), B, 1e-3 * B);
}

TEST(FieldCard, LooksAtFieldsWhenTheyAreStrongest) {
  MagneticSource s = source_of(FieldKind::quadrupole);
  s.gradient = 4000, s.plane = "zx";
  s.time = TimeCourse::pulse, s.start = 0.0501, s.duration = 1e-4;
  const Card pulsed = make_card(with(s), {});
  s.time = TimeCourse::sine, s.frequency = 317;
  const Card alternating = make_card(with(s), {});
  s.time = TimeCourse::constant;
  const Card constant = make_card(with(s), {});
  EXPECT_EQ(line(pulsed, "largest pull")->value, line(constant, "largest pull")->value);
  EXPECT_EQ(line(alternating, "largest pull")->value, line(constant, "largest pull")->value);
}

TEST(FieldCard, SaturatedMomentsArePulledLess) {
  Case c = with(rod(-3.1e-3));
  const double linear = std::stod(line(make_card(c, {}), "largest pull")->value);
  c.carriers[0].saturation_magnetisation = 446e3;
  const double saturated = std::stod(line(make_card(c, {}), "largest pull")->value);
  EXPECT_LT(saturated, 0.95 * linear);
  // m = M_s V_c in a field that is strong enough.
  const auto law = magnetisation(c, c.carriers[0]);
  const LatticeUnits units = lattice_units(c);
  const double moment_si =
      law.moment({0, 0, 1e6}).z * std::pow(units.dx, 3) * units.magnetic_field() / mu;
  EXPECT_NEAR(moment_si / (446e3 * magnetic_volume(c.carriers[0])), 1, 1e-4);
}

}  // namespace
