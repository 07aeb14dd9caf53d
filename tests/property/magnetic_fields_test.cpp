// External fields: exact gradients, Maxwell's equations, time factors, and the grammar they are
// written in.
#include <gtest/gtest.h>

#include <sstream>

#include "base/error.hpp"
#include "magnetic/field_words.hpp"
#include "magnetic/moment.hpp"
#include "support/gradient.hpp"

namespace {

using namespace hemomag;
using test::Random;

magnetic::Field field_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  magnetic::Field field;
  for (std::size_t at = 0; at < words.size();) magnetic::read_source(words, at, field);
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

TEST(Field, ForceIsMinusTheGradientOfTheInducedEnergy) {
  const magnetic::AxialGradient field{2, 0.4, 10};
  Random random(8);
  for (int k = 0; k < 100; ++k) {
    const std::vector<Vec3> x{random.in_cube(5)};
    const auto at = field(x[0]);
    const Vec3 F = magnetic::gradient_force(magnetic::linear_moment(0.1, at.B), at);
    EXPECT_LT(test::gradient_error(x, std::vector<Vec3>{F}, 1,
                                   [&](const auto& y) {
                                     const auto B = field(y[0]).B;
                                     return magnetic::induced_energy(
                                         magnetic::linear_moment(0.1, B), B);
                                   }),
              1e-7);
  }
}

}  // namespace
