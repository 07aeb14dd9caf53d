// The public cell file of the method's authors runs unchanged with our styles. It is not part of
// the project.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "lammps/compat.hpp"
#include "lammps/fix_hemo_watch.h"
#include "lammps/host.hpp"

namespace {

using namespace hemomag;

TEST(AuthorsCell, RunsUnchangedAndKeepsItsAreaAndVolume) {
  const char* given = std::getenv("HEMOMAG_SHARED");
  const std::string file = (given ? std::string(given) : HEMOMAG_SOURCE_DIR "/../shared") +
                           "/data/rbc_3286_authors.data";
  if (!std::filesystem::exists(file)) {
    std::printf("skipped: the authors' cell file is not here (%s)\n", file.c_str());
    GTEST_SKIP() << "the authors' cell file is not part of the project";
  }
  lammps::Host host({"-screen", "none", "-log", "none"}, MPI_COMM_WORLD);
  for (const std::string& line :
       {std::string("units lj"), std::string("atom_style molecular"), std::string("newton on"),
        std::string("special_bonds lj/coul 1 1 1"), std::string("comm_modify cutoff 5.0"),
        std::string("neighbor 1.0 bin"), std::string("bond_style hemo/wlc"),
        std::string("angle_style hemo/membrane"), std::string("dihedral_style hemo/bend"),
        "read_data " + file, std::string("pair_style zero 1.0"), std::string("pair_coeff * *"),
        std::string("mass * 1"),
        std::string("neigh_modify every 1 delay 0 check yes exclude molecule/intra all"),
        std::string("fix advect all hemo/advect"), std::string("fix fluid all hemo/fluid tau 1.0"),
        std::string("fix watch all hemo/watch 100 cells all"), std::string("timestep 1.0"),
        std::string("run 1000")})
    host.command(line);
  const auto& seen =
      lammps::find_fix<LAMMPS_NS::FixHemoWatch>(&host.lammps(), "hemo/watch")->record();
  std::printf("authors' cell, 1,000 steps: area drift %.2e, volume drift %.2e, tolerance 1e-2\n",
              seen.area_drift_max, seen.volume_drift_max);
  EXPECT_LT(seen.area_drift_max, 0.01);
  EXPECT_LT(seen.volume_drift_max, 0.01);
}

}  // namespace
