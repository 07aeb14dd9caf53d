#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/aligned.hpp"
#include "base/simd.hpp"
#include "base/vec3.hpp"
#include "fluid/plates.hpp"
#include "fluid/relaxation.hpp"
#include "fluid/sweep.hpp"
#include "ibm/transfer.hpp"
#include "lattice/node_layout.hpp"
#include "solver/halo_exchange.hpp"
#include "solver/neighbourhood.hpp"

namespace hemomag::solver {

/// What the fluid is, in lattice units. Plates close an axis; the others are periodic.
struct FluidParameters {
  fluid::Relaxation relaxation{1.0, 3.0 / 16};
  ibm::DeltaKernel kernel = ibm::DeltaKernel::cosine4;
  int plate_axis = -1;                   ///< 0, 1, 2, or -1: no plates
  std::array<Vec3, 2> plate_velocity{};  ///< low, high
  double reach_beyond_block = 0;  ///< how far a rank's points may lie outside its block, in nodes
};

/// The fluid on this rank's block: populations, force and velocity on the nodes, and the order in
/// which they are communicated. One time step is
///     clear_forces(); spread(...) any number of times; step(); interpolate(...)
/// after step() the velocity is that at the time of the forces, u = (sum e_i f_i + F/2)/rho, on
/// block and halo.
class FluidSolver {
public:
  /// @throws Error when a block is thinner than the coupling halo (too many ranks along an axis)
  FluidSolver(const Neighbourhood& at, const FluidParameters& parameters);
  FluidSolver(const FluidSolver&) = delete;  // its halo exchange looks at its own neighbourhood
  FluidSolver& operator=(const FluidSolver&) = delete;

  /// Set density 1 and a velocity field with its gradient; `at` gives them for global node
  /// positions.
  template <class Field> void initialise(Field velocity_and_gradient);

  void clear_forces();
  /// Eqs. 29, 36. Collective: a rank without points calls it with none. @return index of the first
  /// point that left the halo, or -1
  std::ptrdiff_t spread(std::span<const Vec3> x, const ibm::Selection& selection,
                        std::span<const Vec3> f);
  /// Sum the forces of all ranks, collide, stream, bounce; leaves the new velocity on block and
  /// halo.
  void step();
  /// Eqs. 32, 34. @return index of the first point that left the halo, or -1
  std::ptrdiff_t interpolate(std::span<const Vec3> x, const ibm::Selection& selection,
                             std::span<Vec3> u) const;

  const lattice::Block& block() const { return at_.block; }
  const FluidParameters& parameters() const { return parameters_; }
  double viscosity() const { return parameters_.relaxation.viscosity(); }

  /// Memory of the populations, forces and velocities of this rank.
  std::size_t bytes() const {
    return sizeof(double) * (f_storage_.size() + force_storage_.size() + u_storage_.size());
  }

  /// Density and velocity of the owned nodes, x fastest.
  void copy_owned(std::span<double> rho, std::span<Vec3> u);
  /// Largest |u| on the owned nodes of this rank.
  double max_speed() const;
  /// Mass of the owned nodes of this rank, less that of the fluid at rest at density one.
  double excess_mass();
  double mass() { return static_cast<double>(block().owned()) + excess_mass(); }
  /// Sum of e_i f_i over the owned nodes of this rank, after the last step's forces have acted in
  /// full.
  Vec3 momentum();
  /// Force spread on nodes of this rank in the last step (body force left out).
  Vec3 node_force() const;
  /// Part of the spread force that went to the plates, in the last step, on this rank.
  Vec3 plate_share() const { return plate_share_; }
  /// Momentum given to the low and high plate by bounce-back in the last step, on this rank.
  const std::array<Vec3, 2>& plate_momentum() const { return plate_momentum_; }

private:
  void set_node(int x, int y, int z, const std::array<double, 19>& g);
  void finish_initialise();
  void reduce_forces();
  void send_populations_forward();
  void send_populations_home();
  void exchange_velocity(int first_axis);
  void wrap_edges_home();
  template <class Visit> void for_each_population(Visit visit);
  fluid::SweepFields sweep_fields();
  lattice::NodeBox with_halo(int axes_done, int halo) const;
  struct Faces {
    lattice::NodeBox whole, ghost_low, first, last, ghost_high;
  };
  Faces faces(int axis, int width) const;
  std::array<double*, 5> crossing(int axis, int sense) const;

  Neighbourhood at_;
  FluidParameters parameters_;
  SimdLevel simd_ = simd_level();
  lattice::NodeLayout f_layout_, n_layout_;
  AlignedArray<double> f_storage_, force_storage_, u_storage_;
  fluid::Populations f_{};
  fluid::NodeVector force_{}, u_{};
  HaloExchange halo_;
  std::vector<fluid::Plate> plates_;
  bool wraps_x_ = false;  // this rank is its own neighbour along x: the sweep keeps those ghosts
  fluid::Pass next_ = fluid::Pass::local;
  bool forces_clear_ = true;
  Vec3 plate_share_;
  std::array<Vec3, 2> plate_momentum_{};
};

}  // namespace hemomag::solver

#include "solver/fluid_solver_initialise.hpp"
