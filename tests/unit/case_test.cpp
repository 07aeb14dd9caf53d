// Units, the table of keys and its reference page, lattice units and the card.
#include <cstdio>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "case/card.hpp"
#include "case/case_file.hpp"
#include "case/keys.hpp"
#include "case/lattice_units.hpp"
#include "case/units.hpp"

namespace {

using namespace hemomag::case_;

TEST(Units, ConvertToSI) {
  EXPECT_DOUBLE_EQ(quantity("27 um", dimension::length), 27e-6);
  EXPECT_DOUBLE_EQ(quantity("125nm", dimension::length), 125e-9);
  EXPECT_DOUBLE_EQ(quantity(" +1e-3 mm ", dimension::length), 1e-6);
  EXPECT_DOUBLE_EQ(quantity("0 um", dimension::length), 0);
  EXPECT_DOUBLE_EQ(quantity("200 s-1", dimension::rate), 200);
  EXPECT_DOUBLE_EQ(quantity("200 Hz", dimension::rate), 200);
  EXPECT_DOUBLE_EQ(quantity("1.2 mPa.s", dimension::viscosity), 1.2e-3);
  EXPECT_DOUBLE_EQ(quantity("1.2 cP", dimension::viscosity), 1.2e-3);
  EXPECT_DOUBLE_EQ(quantity("0.05 T", dimension::field), 0.05);
  EXPECT_DOUBLE_EQ(quantity("500 G", dimension::field), 0.05);
  EXPECT_DOUBLE_EQ(quantity("10 min", dimension::time), 600);
  EXPECT_DOUBLE_EQ(quantity("6.3 uN/m", dimension::tension), 6.3e-6);
  EXPECT_DOUBLE_EQ(quantity("2e4 N/m3", dimension::force_density), 2e4);
  EXPECT_DOUBLE_EQ(quantity("3.84 um-1", dimension::per_length), 3.84e6);
}

TEST(Units, RefuseWhatIsNoQuantity) {
  for (const char* text :
       {"", "um", "27", "2-3 um", "27 um since 2000", "27 um @ 3", "27 furlongz", "27 s", "nan um",
        "inf um", "27 um 3", "--2 um", "27 um;", "0x10 um", "1e400 um"})
    EXPECT_THROW(quantity(text, dimension::length), hemomag::Error) << text;
  EXPECT_THROW(quantity("200 rpm", dimension::rate), hemomag::Error);
}

/// Rows of the reference page, one a key.
std::string reference_row(const Key& key) {
  const std::string table = key.table, name = (table.empty() ? "" : table + ".") + key.name;
  const std::string fallback = key.fallback;
  return "| `" + name + "` | " + accepted(key) + " | " +
         (fallback == "required" ? "required"
          : fallback.empty()     ? "none"
                                 : "`" + fallback + "`") +
         " | " + key.help + " |";
}

TEST(Keys, TheReferencePageListsThemAll) {
  std::ifstream file(HEMOMAG_SOURCE_DIR "/docs/case_file.md");
  std::stringstream page;
  page << file.rdbuf();
  for (const Key& key : keys())
    EXPECT_NE(page.str().find(reference_row(key)), std::string::npos)
        << "docs/case_file.md lacks the row\n"
        << reference_row(key);
}

TEST(Keys, NearestNameIsFound) {
  EXPECT_EQ(nearest_name("carrier", "raduis"), "radius");
  EXPECT_EQ(nearest_name("", "chanel"), "channel");
  EXPECT_EQ(nearest_name("carrier", "entirely_else"), "");
}

/// The study's channel at dx = 0.5 um, tau 1, cell Reynolds number 0.5.
Case coarse() {
  Case c;
  c.channel.size = {27e-6, 36e-6, 24e-6};
  c.channel.shear_rate = 200;
  c.fluid.viscosity = 1.2e-3;
  c.numerics.dx = 0.5e-6;
  c.numerics.cell_reynolds = 0.5;
  c.run.time = 1.4;
  return c;
}

TEST(LatticeUnits, MatchTheTabulatedCoarsePreset) {
  const Case c = coarse();
  const auto u = lattice_units(c);
  EXPECT_NEAR(u.dt, 6.81e-6, 0.01e-6);
  EXPECT_NEAR(u.density / 1000, 196, 0.5);
  EXPECT_NEAR(plate_velocity(c)[1] / u.velocity(), 0.0654, 1e-4);
  EXPECT_NEAR(6.3e-6 / u.tension(), 0.01192, 1e-5);
  EXPECT_NEAR(4.72e-6 / u.tension(), 0.00893, 1e-5);
  EXPECT_NEAR(2.31e-4 / u.tension(), 0.437, 1e-3);
  EXPECT_NEAR(249 / u.pressure(), 0.236, 1e-3);
  EXPECT_NEAR(5e-19 / u.energy(), 0.00379, 1e-5);
  EXPECT_NEAR(kBT / u.energy(), 3.1e-5, 1e-6);
  EXPECT_NEAR(static_cast<double>(steps(c)), 2.05e5, 500);
}

TEST(LatticeUnits, MatchTheTabulatedFinePreset) {
  Case c = coarse();
  c.numerics.dx = 0.25e-6;
  const auto u = lattice_units(c);
  EXPECT_NEAR(u.dt, 1.70e-6, 0.01e-6);
  EXPECT_NEAR(plate_velocity(c)[1] / u.velocity(), 0.0327, 1e-4);
  EXPECT_NEAR(6.3e-6 / u.tension(), 0.00596, 1e-5);
}

const CardLine& line(const Card& card, const std::string& name) {
  for (const CardLine& l : card.lines)
    if (l.name == name) return l;
  throw hemomag::Error("the card has no line " + name);
}

TEST(Card, JudgesTheFieldAgainstTheMethod) {
  Case c = coarse();
  c.carriers.emplace_back();
  c.carriers[0].radius = 125e-9;
  c.carriers[0].count = 80;
  c.magnetic.field = FieldKind::gradient;
  c.magnetic.B0 = 0.1;
  EXPECT_FALSE(make_card(c, {}).refused());
  EXPECT_EQ(line(make_card(c, {}), "contact sub-steps").value, "2");
  c.magnetic.B0 = 0.2;
  EXPECT_EQ(line(make_card(c, {}), "contact sub-steps").value, "8");
  c.magnetic.B0 = 1.0;
  const Card strong = make_card(c, {});
  EXPECT_TRUE(strong.refused());
  EXPECT_EQ(line(strong, "drift").verdict, Verdict::refused);
}

TEST(Card, NamesTheLargestStableWormBond) {
  Case c = coarse();
  c.carriers.emplace_back();
  c.carriers[0].kind = CarrierKind::worm;
  c.carriers[0].radius = 125e-9;
  c.carriers[0].count = 1;
  const Card stiff = make_card(c, {});
  EXPECT_EQ(line(stiff, "worm bond stability").verdict, Verdict::refused);
  EXPECT_EQ(line(stiff, "worm bond stability").value, "8 k dt/Gamma = 9.91")
      << "Table 1's constant at this time step";
  c.carriers[0].stretching = 2 * bare_friction(c, c.carriers[0]) / (8 * lattice_units(c).dt) * 0.99;
  EXPECT_NE(line(make_card(c, {}), "worm bond stability").verdict, Verdict::refused);
}

TEST(Card, RefusesCarriersLargerThanTheKernel) {
  Case c = coarse();
  c.carriers.emplace_back();
  c.carriers[0].radius = 0.7e-6;
  EXPECT_TRUE(make_card(c, {}).refused());
  c.carriers[0].feedback = false;
  EXPECT_FALSE(make_card(c, {}).refused());
}

TEST(Examples, AreAcceptedAndNotRefused) {
  for (const char* name : {"margination_demo", "one_way_drift"}) {
    const Case c = read_case(std::string(HEMOMAG_SOURCE_DIR "/examples/") + name + ".toml", {});
    EXPECT_FALSE(make_card(c, cell_models(c)).refused()) << name;
  }
  const Case demo = read_case(HEMOMAG_SOURCE_DIR "/examples/margination_demo.toml",
                              {"magnetic.B0=0.03 T", "cell.vertices=642"});
  EXPECT_DOUBLE_EQ(demo.magnetic.B0, 0.03);
  EXPECT_EQ(cell_count(demo, demo.cells[0], cell_models(demo)[0]), 14);
  EXPECT_NE(demo.text.find("0.03 T"), std::string::npos) << "the case as run holds the overrides";
}

}  // namespace
