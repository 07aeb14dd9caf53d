#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/vec3.hpp"
#include "lammps/host.hpp"

namespace hemomag::app {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format(const char* text, ...);

/// Carriers in fluid at rest, run by LAMMPS with the hemo styles on the calling rank. Lattice
/// units.
class CarrierRun {
public:
  struct Setup {
    std::array<int, 3> nodes{};
    enum class Walls { none, plates } walls = Walls::none;  ///< plates close z
    std::vector<double> radii;      ///< one atom type each; empty: no fix hemo/drag and no fluid
    int types = 1;                  ///< without radii
    std::vector<Vec3> x;            ///< of the carriers, all of type 1
    std::string pair = "zero 1.0";  ///< pair_style
    std::string pair_coeff = "* *";
    std::string drag;                 ///< more options of fix hemo/drag
    std::vector<std::string> forces;  ///< fixes between drag and fluid
    std::string fluid = "tau 1.0";    ///< options of fix hemo/fluid
  };

  explicit CarrierRun(const Setup& setup);

  void command(const std::string& line) { host_.command(line); }
  void run(long steps) { host_.command("run " + std::to_string(steps) + " post no"); }
  /// Put carrier k (from 0) somewhere else.
  void place(int k, const Vec3& x);
  std::vector<Vec3> x();
  std::vector<Vec3> v();
  std::vector<Vec3> f();
  /// Of the fluid, after the last step's forces have acted.
  Vec3 fluid_momentum();
  /// Of the fluid on its nodes, x fastest.
  std::vector<Vec3> fluid_velocity();
  /// Sub-steps of the contact forces.
  int substeps();
  LAMMPS_NS::LAMMPS& lammps() { return host_.lammps(); }

private:
  lammps::Host host_;
};

}  // namespace hemomag::app
