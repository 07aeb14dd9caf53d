// A run that is resumed from a checkpoint equals, bit by bit, the run that wrote it and went on:
// all that the project can simulate, on one and on two ranks.
#include <string>
#include <vector>

#include "support/run_directory.hpp"

namespace hemomag::test {
namespace {

constexpr const char* plates = R"([channel]
size = ["8 um", "9 um", "8 um"]
shear_rate = "200 s-1"
)";
constexpr const char* symmetric = R"([channel]
size = ["8 um", "9 um", "8 um"]
plates = "symmetric"
shear_rate = "200 s-1"
)";
constexpr const char* driven = R"([channel]
size = ["8 um", "9 um", "8 um"]
mean_velocity = "0.5 mm/s"
)";
constexpr const char* periodic = R"([channel]
size = ["8 um", "9 um", "8 um"]
boundary = "periodic"
body_force = "20000 N/m3"
)";
constexpr const char* tube = R"([channel]
size = ["11 um", "10 um", "11 um"]
boundary = "tube"
diameter = "10 um"
mean_velocity = "0.5 mm/s"
)";
constexpr const char* voxels = R"([channel]
size = ["24 um", "48 um", "24 um"]
boundary = "voxels"
geometry = ")" HEMOMAG_SOURCE_DIR R"(/examples/stenosis.stl"
mean_velocity = "0.5 mm/s"
)";
constexpr const char* cells = R"([[cell]]
count = 1
vertices = 642
)";
constexpr const char* particles = R"([[carrier]]
count = 12
radius = "125 nm"
)";
constexpr const char* heavy = R"([[carrier]]
count = 12
radius = "125 nm"
density = "2000 kg/m3"
)";
constexpr const char* saturating = R"([[carrier]]
count = 12
radius = "125 nm"
saturation_magnetisation = "400 kA/m"
)";
constexpr const char* one_way = R"([[carrier]]
count = 12
radius = "125 nm"
feedback = false
)";
constexpr const char* surfaces = R"([contact]
carrier_contact = "surface"
)";
constexpr const char* measured = R"([analysis]
layer = "measured"
layer_run = "0.1 ms"
)";
constexpr const char* often = "profiles = \"0.03 ms\"\n";
constexpr const char* worms = R"([[carrier]]
kind = "worm"
count = 2
beads = 6
stretching = "150 uN/m"
radius = "125 nm"
)";
constexpr const char* gradient = R"([magnetic]
field = "gradient"
gradient = "-4000 T/m"
zero_at = ["0 um", "0 um", "9 um"]
)";

struct Study {
  const char* name;
  std::string channel, contents, numerics = "", magnetic = "", output = "";
  int steps = 150;
};

std::string text(const Study& s) {
  const bool sheared = s.channel.find("shear_rate") != std::string::npos;
  const bool coarse = s.channel == voxels;
  return std::string("title = \"") + s.name + "\"\n" + s.channel +
         "[fluid]\nviscosity = \"1.2 mPa.s\"\n[numerics]\n" +
         (coarse ? "dx = \"1 um\"\n" : "dx = \"0.5 um\"\n") +
         (sheared  ? "cell_reynolds = 0.25\n"
          : coarse ? "dt = \"10 us\"\n"
                   : "dt = \"4 us\"\n") +
         s.numerics + s.contents + s.magnetic + "[run]\nsteps = " + std::to_string(s.steps) +
         "\ncheckpoint = \"1 h\"\n[output]\nfields = \"0.2 ms\"\nseries = \"0.05 ms\"\n" + s.output;
}

const std::vector<Study> studies = {
    {"Particles", plates, particles, "", gradient},
    {"Worms", plates, worms, "", gradient},
    {"Cells", plates, cells},
    {"CellsAndParticles", plates, std::string(cells) + particles, "", gradient},
    {"CellsAndWorms", plates, std::string(cells) + worms, "", gradient},
    {"Bgk", plates, particles, "scheme = \"bgk\"\n"},
    {"Exponential", plates, std::string(cells) + particles, "scheme = \"exponential\"\n"},
    {"Single", plates, std::string(cells) + particles, "precision = \"single\"\n"},
    {"SingleExponential", plates, particles, "precision = \"single\"\nscheme = \"exponential\"\n"},
    {"Periodic", periodic, std::string(cells) + particles, "", gradient},
    {"PeriodicExponential", periodic, particles, "scheme = \"exponential\"\n"},
    {"Tube", tube, std::string(cells) + particles, "", gradient},
    {"TubeExponential", tube, particles, "scheme = \"exponential\"\n"},
    {"TubeSingle", tube, particles, "precision = \"single\"\n"},
    {"Voxels", voxels, particles, "", gradient},
    {"VoxelsSingleExponential", voxels, particles,
     "precision = \"single\"\nscheme = \"exponential\"\n"},
    {"Inertial", plates, heavy, "", gradient},
    {"InertialInTube", tube, std::string(cells) + heavy, "", gradient},
    {"SurfaceContact", plates, std::string(cells) + particles + surfaces, "", gradient},
    {"Profiles", plates, std::string(cells) + particles, "", gradient, often},
    {"ProfilesExponential", plates, particles, "scheme = \"exponential\"\n", gradient, often},
    {"MeasuredLayer", plates, std::string(cells) + particles + measured, "", gradient},
    {"Uniform", plates, particles, "", "[magnetic]\nfield = \"uniform\"\nB0 = \"0.05 T\"\n"},
    {"Rotating", plates, particles, "",
     "[magnetic]\nfield = \"rotating\"\nB0 = \"5 mT\"\nfrequency = \"500 Hz\"\n"},
    {"Sine", plates, particles, "",
     "[magnetic]\nfield = \"uniform\"\nB0 = \"0.05 T\"\ntime = \"sine\"\nfrequency = \"900 Hz\"\n"},
    {"Ramp", plates, particles, "",
     "[magnetic]\nfield = \"gradient\"\ntime = \"ramp\"\nstart = \"0.1 ms\"\nduration = \"0.4 "
     "ms\"\n"},
    {"Magnet", plates, particles, "",
     "[magnetic]\nfield = \"magnet\"\nshape = \"cylinder\"\nposition = [\"4 um\", \"4 um\", \"-3 "
     "mm\"]\n"
     "diameter = \"4 mm\"\nlength = \"5 mm\"\nremanence = \"0.4 T\"\n"},
    {"Coil", plates, particles, "",
     "[magnetic]\nfield = \"coil\"\nposition = [\"4 um\", \"4 um\", \"-1 mm\"]\ndiameter = \"4 "
     "mm\"\n"
     "current = \"200 A\"\n"},
    {"CoilPair", plates, particles, "",
     "[magnetic]\nfield = \"coil\"\nposition = [\"4 um\", \"4 um\", \"4 um\"]\ndiameter = \"4 "
     "mm\"\n"
     "current = \"200 A\"\npair = \"opposite\"\ndistance = \"3 mm\"\n"},
    {"Block", plates, particles, "",
     "[magnetic]\nfield = \"magnet\"\nshape = \"block\"\nposition = [\"4 um\", \"4 um\", \"-3 "
     "mm\"]\n"
     "size = [\"2 mm\", \"3 mm\", \"4 mm\"]\nremanence = \"0.4 T\"\n"},
    {"Wire", plates, particles, "",
     "[magnetic]\nfield = \"wire\"\nposition = [\"4 um\", \"4 um\", \"-1 mm\"]\naxis = \"x\"\n"
     "current = \"200 A\"\ntime = \"pulse\"\nduration = \"0.5 ms\"\n"},
    {"Table", plates, particles, "", "[magnetic]\nfield = \"table\"\nfile = \"B.csv\"\n"},
    {"Quadrupole", plates, particles, "",
     "[magnetic]\nfield = \"quadrupole\"\ngradient = \"4000 T/m\"\n"},
    {"Sources", plates, particles, "",
     "[magnetic]\n[[magnetic.source]]\nfield = \"uniform\"\nB0 = \"0.02 T\"\n"
     "[[magnetic.source]]\nfield = \"rotating\"\nB0 = \"5 mT\"\nfrequency = \"500 Hz\"\n"},
    {"Saturating", plates, saturating, "", gradient},
    {"OneWay", plates, one_way, "", gradient},
    {"PaperRepulsion", plates, std::string(particles) + "[contact]\nrepulsion = \"paper\"\n", "",
     gradient},
    {"Peskin4", plates, std::string(cells) + particles, "kernel = \"peskin4\"\n", gradient},
    {"Roma3", plates, std::string(cells) + particles, "kernel = \"roma3\"\n", gradient},
    {"Linear2", plates, particles, "kernel = \"linear2\"\n", gradient},
    {"SymmetricPlates", symmetric, std::string(cells) + particles, "", gradient},
    {"PlatesAndMeanVelocity", driven, std::string(cells) + particles, "", gradient},
    {"PlateletAndWhite", plates,
     "[[cell]]\nkind = \"platelet\"\ncount = 2\n[[cell]]\nkind = \"white\"\ndiameter = \"5 "
     "um\"\ncount = 1\n"},
    {"OffSphere", plates, "[[cell]]\ncount = 1\nvertices = 642\nstress_free = \"sphere\"\n"},
};

/// A grid of 4 x 4 x 4 points that covers the channel.
std::string field_table() {
  std::string rows = "x_m,y_m,z_m,Bx_T,By_T,Bz_T\n";
  for (int k = 0; k < 64; ++k)
    rows += std::to_string(k % 4 * 3) + "e-6," + std::to_string(k / 4 % 4 * 3) + "e-6," +
            std::to_string(k / 16 * 3) + "e-6,0,0," + std::to_string(0.05 - 0.01 * (k / 16)) + "\n";
  return rows;
}

class Resume : public RunDirectory, public testing::WithParamInterface<std::tuple<int, Study>> {
protected:
  int ranks() const { return std::get<0>(GetParam()); }
};

TEST_P(Resume, EqualsTheRunThatWentOn) {
  write_case(text(std::get<1>(GetParam())));
  std::ofstream(directory_ / "B.csv") << field_table();
  const Outcome whole = run(ranks(), "whole");
  ASSERT_EQ(whole.code, 0) << whole.said;
  // The checkpoint at the end goes; the one before it is of the first hundred steps.
  copy("whole", "resumed");
  std::filesystem::remove_all(directory_ / "resumed/checkpoint");
  std::filesystem::remove(directory_ / "resumed/summary.json");
  const Outcome resumed = run(ranks(), "resumed", "--resume");
  ASSERT_EQ(resumed.code, 0) << resumed.said;
  EXPECT_NE(resumed.said.find("going on from step"), std::string::npos) << resumed.said;
  EXPECT_EQ(resumed.said.find("cell-free layer"), std::string::npos) << "measured again";
  expect_same("whole", "resumed");
}

// LAMMPS writes the size of a buffer into its file that differs when there are no atoms at all.
using PlasmaAlone = RunDirectory;
TEST_F(PlasmaAlone, EqualsTheRunThatWentOn) {
  write_case(text({"PlasmaAlone", plates, "", "", "", often}));
  ASSERT_EQ(run(1, "whole").code, 0);
  copy("whole", "resumed");
  std::filesystem::remove_all(directory_ / "resumed/checkpoint");
  ASSERT_EQ(run(1, "resumed", "--resume").code, 0);
  for (const char* name : {"checkpoint/fluid.h5", "profiles.csv", "layer.csv"})
    EXPECT_TRUE(content(directory_ / "whole" / name) == content(directory_ / "resumed" / name))
        << name;
}

INSTANTIATE_TEST_SUITE_P(Everything, Resume,
                         testing::Combine(testing::Values(1, 2), testing::ValuesIn(studies)),
                         [](const auto& info) {
                           return std::string(std::get<1>(info.param).name) +
                                  std::to_string(std::get<0>(info.param));
                         });

}  // namespace
}  // namespace hemomag::test
