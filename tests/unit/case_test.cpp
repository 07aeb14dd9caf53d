// Units, the table of keys and its reference page, lattice units, vessels and the card.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "case/card.hpp"
#include "case/case_file.hpp"
#include "case/keys.hpp"
#include "case/lattice_units.hpp"
#include "case/placement.hpp"
#include "case/script.hpp"
#include "case/units.hpp"
#include "case/vessel.hpp"

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
  // Reciprocals, which UDUNITS would convert.
  EXPECT_THROW(quantity("200 s", dimension::rate), hemomag::Error);
  EXPECT_THROW(quantity("5 ms", dimension::frequency), hemomag::Error);
  EXPECT_THROW(quantity("3 um", dimension::per_length), hemomag::Error);
  EXPECT_THROW(quantity("200 s-1", dimension::time), hemomag::Error);
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

TEST(Keys, TheDefaultsOfARedCellAreThoseOfTheTable) {
  const Cell red = standard_cell(CellKind::rbc);
  const auto number = [](const char* name) { return std::stod(find_key("cell", name)->fallback); };
  const auto amount = [](const char* name) {
    const Key* key = find_key("cell", name);
    return quantity(key->fallback, *key->dimension);
  };
  EXPECT_EQ(red.vertices, number("vertices"));
  EXPECT_DOUBLE_EQ(red.shear_modulus, amount("shear_modulus"));
  EXPECT_DOUBLE_EQ(red.bending_modulus, amount("bending_modulus"));
  EXPECT_DOUBLE_EQ(red.diameter, cell_diameter);
  EXPECT_DOUBLE_EQ(standard_cell(CellKind::platelet).thickness, amount("thickness"));
  for (const CellKind kind : {CellKind::platelet, CellKind::white})
    EXPECT_DOUBLE_EQ(standard_cell(kind).shear_modulus, 10 * red.shear_modulus);
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
  c.magnetic.sources.emplace_back();  // of the gradient
  c.magnetic.sources[0].B0 = 0.1;
  EXPECT_FALSE(make_card(c, {}).refused());
  EXPECT_EQ(line(make_card(c, {}), "contact sub-steps").value, "2");
  c.magnetic.sources[0].B0 = 0.2;
  EXPECT_EQ(line(make_card(c, {}), "contact sub-steps").value, "8");
  c.magnetic.sources[0].B0 = 1.0;
  const Card strong = make_card(c, {});
  EXPECT_TRUE(strong.refused());
  EXPECT_EQ(line(strong, "drift").verdict, Verdict::refused);
}

TEST(Card, SaysWhatTheDipolesCutOffNeglectsAndWhatKappaCosts) {
  Case c = coarse();
  c.carriers.emplace_back();
  c.carriers[0].radius = 125e-9;
  c.magnetic.sources.emplace_back();
  c.magnetic.sources[0].B0 = 0.1;
  EXPECT_EQ(line(make_card(c, {}), "dipole cut-off").value,
            "1.5 um, neglects 0.00077 of the contact pull");
  c.contact.repulsion_kappa = 60;
  EXPECT_EQ(line(make_card(c, {}), "contact sub-steps").value, "5") << "2.25 times kappa 30's 1.9";
}

TEST(CarrierInertia, TheFluidTheyDisplaceMovesAlongUnlessCouplingIsOneWay) {
  Case c = coarse();
  c.carriers.emplace_back();
  Carrier& carrier = c.carriers[0];
  carrier.radius = 125e-9;
  EXPECT_EQ(inertial_mass(c, carrier), 0);
  carrier.density = 5200;
  const double scaled =
      lattice_units(c).density / 1000 * 4.0 / 3 * std::numbers::pi * std::pow(125e-9, 3);
  EXPECT_NEAR(inertial_mass(c, carrier) / scaled, 4200, 1e-9 * 4200);
  EXPECT_NE(lammps_script(c, {}).find(" inertia 1 0.2748"), std::string::npos)
      << "4.2 times 4/3 pi 0.25^3";
  EXPECT_EQ(line(make_card(c, {}), "carrier inertia").verdict, Verdict::fine);
  carrier.feedback = false;
  EXPECT_NEAR(inertial_mass(c, carrier) / scaled, 5200, 1e-9 * 5200);
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

TEST(LatticeUnits, TheExponentialSchemeHasItsOwnViscosity) {
  // nu = tau/3 instead of (tau - 1/2)/3: tau 1/2 stands for tau 1 of trt, and 0.05 is allowed.
  Case c = coarse();
  const double standard = lattice_units(c).dt;
  c.numerics.scheme = "exponential";
  c.numerics.tau = 0.5;
  EXPECT_DOUBLE_EQ(lattice_units(c).dt, standard);
  c.numerics.tau = 0.05;
  EXPECT_NEAR(lattice_units(c).dt, 0.1 * standard, 1e-12 * standard);
}

TEST(LatticeUnits, ExponentialTauIsJudgedByItsOwnAccuracy) {
  Case c = coarse();
  c.numerics.scheme = "exponential";
  for (const auto& [tau, verdict] : {std::pair{0.1, Verdict::doubtful},
                                     {0.3, Verdict::fine},
                                     {1.0, Verdict::fine},
                                     {1.4, Verdict::doubtful}}) {
    c.numerics.tau = tau;
    EXPECT_EQ(line(make_card(c, {}), "tau").verdict, verdict) << tau;
  }
}

/// A tube of 20 um along y, plasma at 1 mm/s in the mean.
Case tube() {
  Case c = coarse();
  c.channel.size = {22e-6, 30e-6, 24e-6};
  c.channel.boundary = Boundary::tube;
  c.channel.diameter = 20e-6;
  c.channel.shear_rate = 0;
  c.channel.mean_velocity = 1e-3;
  c.vessel = make_vessel(c);
  return c;
}

TEST(Tube, CellReynoldsUsesThePseudoShearRate) {
  Case c = tube();
  // Re = rho (u/D) R^2/mu
  EXPECT_NEAR(lattice_units(c).density * 50 * 3.91e-6 * 3.91e-6 / 1.2e-3, 0.5, 1e-12);
  c.channel.boundary = Boundary::plates;  // then the height, 24 um
  EXPECT_NEAR(lattice_units(c).density * (1e-3 / 24e-6) * 3.91e-6 * 3.91e-6 / 1.2e-3, 0.5, 1e-12);
}

TEST(Tube, HematocritIsOfTheTubesVolume) {
  Case c = tube();
  c.cells.emplace_back();
  c.cells[0].vertices = 642;
  c.cells[0].hematocrit = 0.2;
  const auto models = cell_models(c);
  const double volume = 3.14159265358979 * 100e-12 * 30e-6;
  EXPECT_NEAR(fluid_volume(c), volume, 1e-10 * volume);
  EXPECT_EQ(cell_count(c, c.cells[0], models[0]),
            static_cast<int>(std::lround(0.2 * volume / models[0].volume)));
  const double made = cell_count(c, c.cells[0], models[0]) * models[0].volume / volume;
  char text[64];
  std::snprintf(text, sizeof text, "hematocrit %.4g", made);
  EXPECT_NE(line(make_card(c, models), "cells").value.find(text), std::string::npos);
}

TEST(Card, SaysHowFarAStressFreeNetworkIsDrawn) {
  Case c = coarse();
  c.cells.emplace_back();
  c.cells[0].count = 1;
  const auto prestress = [&](double ratio) {
    c.cells[0].stretch_ratio = ratio;
    return line(make_card(c, cell_models(c)), "prestress");
  };
  for (const auto& l : make_card(c, cell_models(c)).lines) EXPECT_NE(l.name, "prestress");
  c.cells[0].stress_free = StressFree::sphere;
  // On the spheroid of 0.9 the rim is stretched by 1.157 and no edge by more
  // (stress_free_shape.md).
  const CardLine usual = prestress(1 / 2.2);
  std::printf("prestress: %s\n", usual.value.c_str());
  EXPECT_EQ(usual.verdict, Verdict::fine);
  EXPECT_NEAR(std::stod(usual.value.substr(usual.value.find("l_max") + 5)), 1.157 / 2.2, 0.015);
  EXPECT_NEAR(std::stod(usual.value.substr(usual.value.find("at most") + 7)), 0.157, 0.03);
  EXPECT_EQ(prestress(0.7).verdict, Verdict::doubtful);
  EXPECT_EQ(prestress(0.85).verdict, Verdict::refused) << "0.97 of l_max";
}

TEST(Card, RefusesACellLargerThanTheBox) {
  Case c = coarse();
  c.cells.push_back(standard_cell(CellKind::white));
  c.cells[0].count = 1, c.cells[0].vertices = 162;
  EXPECT_FALSE(make_card(c, cell_models(c)).refused());
  c.cells[0].diameter = 37e-6;  // the longest side is 36 um
  EXPECT_EQ(line(make_card(c, cell_models(c)), "cell size").verdict, Verdict::refused);
}

TEST(CellModels, AVertexOfAPlateletStandsForAsMuchAreaAsOfARedCell) {
  Case c = coarse();
  c.cells.push_back(standard_cell(CellKind::platelet));
  c.cells[0].count = 1;
  const auto models = cell_models(c);
  // A vertex of either stands for (0.22 um)^2: the same energy a pair to 3 %.
  EXPECT_NEAR(models[0].vertex_share, 1, 0.06);
  c.cells[0].vertices = 600;
  EXPECT_NEAR(cell_models(c)[0].vertex_share, models[0].vertex_share / 2, 1e-12);
}

TEST(Tube, FlowIsEstimatedByPoiseuille) {
  Case c = tube();
  EXPECT_NEAR(fastest_flow(c), 2e-3, 1e-15) << "twice the mean";
  const double g = starting_force(c);
  EXPECT_NEAR(g, 8 * 1.2e-3 * 1e-3 / 1e-10, 1e-6) << "8 mu u/R^2";
  c.channel.mean_velocity.reset();
  c.channel.body_force[1] = g;
  EXPECT_NEAR(fastest_flow(c), 2e-3, 1e-15) << "g R^2/(4 mu)";
  c = tube();
  c.channel.boundary = Boundary::plates;
  EXPECT_NEAR(fastest_flow(c), 1.5e-3, 1e-15) << "3/2 of the mean between plates";
}

TEST(Tube, SinglePrecisionAndTheExponentialSchemeChangeTheCost) {
  Case c = tube();
  const auto megabytes = [&] {
    return std::stod(line(make_card(c, {}), "memory").value.substr(6));
  };
  const double nodes = 44. * 60 * 48 / 1e6;
  EXPECT_NEAR(megabytes(), 210 * nodes, 1);
  c.numerics.precision = "single";
  EXPECT_NEAR(megabytes(), 134 * nodes, 1);
  c.numerics.scheme = "exponential";
  EXPECT_NEAR(megabytes(), 210 * nodes, 1);
}

bool has(const std::string& script, const std::string& part) {
  return script.find(part) != std::string::npos;
}

TEST(Tube, ScriptNamesVesselWallAndMeanVelocity) {
  Case c = tube();
  c.numerics.precision = "single";
  c.numerics.kernel = "roma3";
  c.carriers.emplace_back();
  c.carriers[0].count = 1;
  c.carriers[0].radius = 125e-9;
  c.analysis.walls = LayerWalls::vessel;
  const std::string script = lammps_script(c, place(c));
  EXPECT_TRUE(has(script, "boundary p p p\n")) << script;
  EXPECT_TRUE(has(script, "kernel roma3 precision single tube y 22 24 20 mean_velocity y "));
  EXPECT_TRUE(has(script, " walls vessel\n"));
  EXPECT_FALSE(has(script, "wall/lj126"));
  EXPECT_LT(script.find("fix walls all hemo/wall "), script.find("fix fluid all hemo/fluid"));
  c.channel.axis = 2;
  EXPECT_TRUE(has(lammps_script(c, place(c)), "tube z 22 30 20 mean_velocity z "));
}

/// Surface files in a directory of their own. A frustum along y around (cx, cz) = (5, 5), square
/// with half sides h0 and h1 at y0 and y1, in the units of the file.
class Voxels : public testing::Test {
protected:
  void SetUp() override {
    directory_ =
        std::filesystem::temp_directory_path() / ("hemomag_voxels_" + std::to_string(getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  Case frustum(double y0, double h0, double y1, double h1) const {
    const auto path = directory_ / "frustum.off";
    {
      std::ofstream file(path);
      file << "OFF\n8 12 0\n";
      for (const auto& [y, h] : {std::pair{y0, h0}, {y1, h1}})
        file << 5 - h << " " << y << " " << 5 - h << "\n"
             << 5 + h << " " << y << " " << 5 - h << "\n"
             << 5 + h << " " << y << " " << 5 + h << "\n"
             << 5 - h << " " << y << " " << 5 + h << "\n";
      for (const char* t : {"0 1 2", "0 2 3", "4 6 5", "4 7 6", "0 5 1", "0 4 5", "1 6 2", "1 5 6",
                            "2 7 3", "2 6 7", "3 4 0", "3 7 4"})
        file << "3 " << t << "\n";
    }
    Case c = coarse();
    c.channel.size = {10e-6, 8e-6, 10e-6};
    c.channel.shear_rate = 0;
    c.channel.boundary = Boundary::voxels;
    c.channel.geometry = path.string();
    c.channel.geometry_unit = 1e-6;
    c.channel.mean_velocity = 1e-3;
    c.vessel = make_vessel(c);
    return c;
  }

  std::filesystem::path directory_;
};

TEST_F(Voxels, ADuctHoldsTheNodesInsideAndMatchesAtBothEnds) {
  const Case c = frustum(-3, 3.1, 11, 3.1);  // 6.2 um wide in a box of 10 um: 12 nodes of 0.5 um
  EXPECT_EQ(c.vessel.fluid_nodes, 12 * 12 * 16);
  EXPECT_NEAR(fluid_volume(c), 12 * 12 * 16 * 0.125e-18, 1e-27);
  EXPECT_EQ(c.vessel.open, (std::array<long, 3>{0, 144, 0}));
  EXPECT_EQ(c.vessel.unmatched, (std::array<long, 3>{0, 0, 0}));
  EXPECT_GE(c.vessel.widest, 2. / 3 * 5.7) << "of the middle nodes, 6.2 - 0.5";
  EXPECT_LE(c.vessel.widest, 5.7 + 1e-9);
  EXPECT_EQ(line(make_card(c, {}), "open ends").verdict, Verdict::fine);
  EXPECT_NEAR(wall_distance(c, {5e-6, 4e-6, 5e-6}), 3.1e-6, 1e-15);
  EXPECT_NEAR(wall_distance(c, {5e-6, 20e-6, 5e-6}), 3.1e-6, 1e-15) << "a period further";
  const std::string script = lammps_script(c, place(c));
  EXPECT_TRUE(has(script, " surface geometry.off 2 mean_velocity y ")) << script;
}

TEST_F(Voxels, EndsThatDifferAreDoubtfulAndClosedOnesCannotBeDriven) {
  const Case wider = frustum(-2, 1.1, 10, 3.1);  // half sides 1.434 and 2.767 at the faces
  // At the faces' nodes (y = 0.25 and 7.75) the half sides are 1.475 and 2.725 um.
  EXPECT_EQ(wider.vessel.open[1], 6 * 6);
  EXPECT_EQ(wider.vessel.unmatched[1], 10 * 10 - 6 * 6);
  const CardLine ends = line(make_card(wider, {}), "open ends");
  EXPECT_EQ(ends.verdict, Verdict::doubtful);
  EXPECT_NE(ends.advice.find("64 fluid nodes"), std::string::npos) << ends.advice;
  const Case closed = frustum(1, 3, 7, 3);
  EXPECT_EQ(closed.vessel.open, (std::array<long, 3>{0, 0, 0}));
  EXPECT_EQ(line(make_card(closed, {}), "open ends").verdict, Verdict::refused);
}

TEST_F(Voxels, ASurfaceOutsideTheBoxIsRefused) {
  EXPECT_THROW(frustum(20, 3, 27, 3), hemomag::Error);
}

TEST(Examples, AreAcceptedAndNotRefused) {
  for (const char* name : {"margination_demo", "one_way_drift", "tube_flow"}) {
    const Case c = read_case(std::string(HEMOMAG_SOURCE_DIR "/examples/") + name + ".toml", {});
    EXPECT_FALSE(make_card(c, cell_models(c)).refused()) << name;
  }
  const Case demo = read_case(HEMOMAG_SOURCE_DIR "/examples/margination_demo.toml",
                              {"magnetic.B0=0.03 T", "cell.vertices=642"});
  EXPECT_DOUBLE_EQ(demo.magnetic.sources[0].B0, 0.03);
  EXPECT_EQ(cell_count(demo, demo.cells[0], cell_models(demo)[0]), 14);
  EXPECT_NE(demo.text.find("0.03 T"), std::string::npos) << "the case as run holds the overrides";
}

}  // namespace
