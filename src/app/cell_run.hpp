#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "app/stretching.hpp"
#include "case/case.hpp"
#include "lammps/host.hpp"
#include "membrane/mesh.hpp"

namespace hemomag::app {

/// One red cell of Table 1 alone in fluid, in a periodic box or between two plates that shear it,
/// run by LAMMPS with the hemo styles on the calling rank. Lengths in um, forces in pN, about the
/// middle of the box.
class CellRun {
public:
  struct Options {
    int vertices = 642;
    double dx = 0.5;  ///< node spacing [um]
    double dt = 0;    ///< time step [s]; the density follows from it
    case_::Hinges hinges = case_::Hinges::rest;
    case_::StressFree stress_free = case_::StressFree::rest_shape;
    double shear_rate = 0;   ///< [1/s] v_y = shear_rate z between plates; 0: a periodic box
    double fraction = 0.02;  ///< of the vertices in each grip
  };
  static constexpr Vec3 periodic_box{20, 12, 8};  ///< [um] a cell at 200 pN is 16 long
  static constexpr Vec3 shear_box{16, 16, 16};    ///< [um] about two diameters of a cell

  /// Angles in the shear plane in degrees, counted over turns, and semi-axes a >= b >= c in um
  /// (docs/styles/compute_hemo_cell.md). In v_y = G z, G > 0, angles fall.
  struct Motion {
    double inclination, phase;
    std::array<double, 3> semi_axes;
  };

  /// The cell's rest mesh, the same for the same number of vertices.
  static membrane::TriangleMesh rest_mesh(int vertices);

  /// @param out    directory for the data file that LAMMPS reads
  /// @param start  vertices at the beginning, e.g. the rest mesh
  CellRun(const std::string& out, const std::vector<Vec3>& start, const Options& options);

  /// Pull the grips apart along x with this force at each end from now on.
  void pull(double force);
  void run(long steps);
  double time() const { return static_cast<double>(steps_) * dt_; }  ///< [s]
  std::vector<Vec3> x() const;
  /// Counts turns from call to call: call it before the cell turns by a quarter. Not before a run.
  Motion motion();

private:
  std::unique_ptr<lammps::Host> host_;
  Vec3 middle_;           // um
  double dx_, dt_;        // um, s
  double force_unit_;     // pN
  std::size_t held_ = 0;  // vertices in each grip
  long steps_ = 0;
};

}  // namespace hemomag::app
