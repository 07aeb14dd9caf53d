#pragma once
#include <memory>
#include <string>
#include <vector>

#include "app/stretching.hpp"
#include "case/case.hpp"
#include "lammps/host.hpp"
#include "membrane/mesh.hpp"

namespace hemomag::app {

/// One red cell of Table 1 alone in a periodic box of fluid, run by LAMMPS with the hemo styles on
/// the calling rank. Lengths in um, forces in pN, about the middle of the box.
class CellRun {
public:
  struct Options {
    int vertices = 642;
    double dx = 0.5;  ///< node spacing [um]
    double dt = 0;    ///< time step [s]; the density follows from it
    case_::Hinges hinges = case_::Hinges::rest;
    double fraction = 0.02;  ///< of the vertices in each grip
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

private:
  std::unique_ptr<lammps::Host> host_;
  Vec3 middle_;           // um
  double dx_, dt_;        // um, s
  double force_unit_;     // pN
  std::size_t held_ = 0;  // vertices in each grip
  long steps_ = 0;
};

}  // namespace hemomag::app
