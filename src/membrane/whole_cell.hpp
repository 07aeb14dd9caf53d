#pragma once
#include <span>
#include <vector>

#include "membrane/bending.hpp"
#include "membrane/mesh.hpp"
#include "membrane/springs.hpp"
#include "membrane/topology.hpp"

namespace hemomag::membrane {

/// Constants of a red cell's membrane (Eqs. 15-20), in any consistent units.
struct Moduli {
  double mu0 = 0;            ///< shear modulus of the springs [force/length]
  double k_a = 0;            ///< global area [force/length]
  double k_d = 0;            ///< local area [force/length]
  double k_v = 0;            ///< volume [force/length^2]
  double k_b = 0;            ///< hinges [energy]
  double x0 = 1 / 2.2;       ///< rest length over the longest
  double m = 2;              ///< exponent of the repulsion
  bool flat_hinges = false;  ///< rest angle 0 on every hinge instead of the mesh's own
};

/// One whole cell whose rest state, of every edge, triangle and hinge, is a given mesh. The plain
/// sum of the laws of this room: for statics and as a reference, not for the time step.
class WholeCell {
public:
  /// @throws hemomag::Error when the mesh is not closed
  WholeCell(const TriangleMesh& rest, const Moduli& moduli);

  /// Energy of the state `x` and its forces, minus the gradient.
  /// @param x      [n_v]
  /// @param force  [n_v]  overwritten
  /// @return infinity where an edge is drawn out to its l_max
  double energy(std::span<const Vec3> x, std::span<Vec3> force) const;

  double area(std::span<const Vec3> x) const;
  double volume(std::span<const Vec3> x) const;
  double rest_area() const { return area0_; }
  double rest_volume() const { return volume0_; }
  /// Longest edge over its own l_max.
  double largest_extension(std::span<const Vec3> x) const;

private:
  double triangle_energies(std::span<const Vec3> x, std::span<Vec3> force) const;

  Moduli moduli_;
  std::vector<std::array<int, 3>> triangles_;
  Topology topology_;
  std::vector<Spring> springs_;  // [n_e]
  std::vector<Bending> hinges_;  // [n_e]
  std::vector<double> areas0_;   // [n_t]
  double area0_ = 0, volume0_ = 0;
};

}  // namespace hemomag::membrane
