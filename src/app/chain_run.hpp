#pragma once
#include <array>
#include <vector>

#include "app/carrier_run.hpp"

namespace hemomag::app {

/// A chain of touching carriers, held together by their dipoles alone, in a rotating field in a
/// periodic box of fluid. Radius one node, kappa 60, dipoles between all pairs. Lattice units.
class ChainRun {
public:
  struct Options {
    int carriers = 11;
    double speed = 1;       ///< angular frequency over the table's critical one; sets the field
    double box = 2.5;       ///< sides of the cube, in chain lengths
    double reynolds = 0.1;  ///< of the tip, its speed times a diameter over the viscosity
  };

  explicit ChainRun(const Options& options);

  /// Turn on by about a degree.
  void advance();
  double turns() const;  ///< of the field, so far
  /// Angle by which the line from the first to the last carrier lags behind the field, in [0, 90]
  /// degrees.
  double lag() const;
  /// Loss of phase (a lag beyond 87 degrees) or a gap between neighbours of more than 1.5 diameters
  /// from centre to centre.
  bool broken() const;
  /// Largest angle between the first or last bond and the middle ones, in degrees.
  double bend() const;
  /// Least angle by which the end bonds are turned from the middle ones, in degrees, when both are
  /// turned the same way, as in an S; else zero.
  double s_shape() const;
  /// Groups of carriers nearer to one another than 1.5 diameters.
  int fragments() const;

  double radius() const { return 1; }
  int side() const { return side_; }
  const std::vector<Vec3>& x() const { return x_; }
  double field_angle() const;  ///< [rad]
  double tip_speed() const;
  int substeps() { return run_.substeps(); }
  long steps() const { return steps_; }
  /// Of the fluid on the nodes of the chain's plane, x fastest.
  std::vector<Vec3> flow_in_plane();

private:
  /// Angles from the middle bonds to the first and last one, positive the field's way, in degrees.
  std::array<double, 2> turned_ends() const;

  int carriers_, side_;
  double omega_;  ///< rad a step
  int stride_;    ///< steps between looks
  long steps_ = 0;
  CarrierRun run_;
  std::vector<Vec3> x_;
};

}  // namespace hemomag::app
