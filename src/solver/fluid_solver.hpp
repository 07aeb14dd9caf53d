#pragma once
#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "base/vec3.hpp"
#include "fluid/equilibrium.hpp"
#include "fluid/relaxation.hpp"
#include "fluid/wall_links.hpp"
#include "ibm/transfer.hpp"
#include "lattice/vessel.hpp"
#include "solver/neighbourhood.hpp"

namespace hemomag::solver {

enum class Precision { double_, single_ };

/// What the fluid is, in lattice units. Plates close an axis; the others are periodic. A vessel
/// lies in a periodic box.
struct FluidParameters {
  fluid::Relaxation relaxation{1.0, 3.0 / 16};
  Precision precision = Precision::double_;
  ibm::DeltaKernel kernel = ibm::DeltaKernel::cosine4;
  int plate_axis = -1;                                        ///< 0, 1, 2, or -1: no plates
  std::array<Vec3, 2> plate_velocity{};                       ///< low, high
  std::shared_ptr<const lattice::Vessel> vessel;              ///< excludes plates; null: none
  fluid::WallRule wall_rule = fluid::WallRule::interpolated;  ///< of the vessel
  double reach_beyond_block = 0;  ///< how far a rank's points may lie outside its block, in nodes
};

/// Nodes around a block that its points can reach, which every neighbouring block must hold.
int coupling_halo(double reach_beyond_block);

/// Distance of a point from a vessel's wall and its gradient.
struct WallDistance {
  double distance;
  Vec3 gradient;
};

/// The fluid on this rank's block: populations, force and velocity on the nodes, and the order in
/// which they are communicated. One time step is
///     clear_forces(); spread(...) any number of times; step(); interpolate(...)
/// after step() the velocity is that at the time of the forces on block and halo:
/// u = (sum e_i f_i + F/2)/rho, in the exponential scheme u = sum e_i f_i/rho.
class FluidSolver {
public:
  using Flow = std::pair<Vec3, fluid::VelocityGradient>;

  virtual ~FluidSolver() = default;

  /// Set density 1 and a velocity field with its gradient, given for global node positions.
  virtual void initialise(const std::function<Flow(const Vec3&)>& field) = 0;

  virtual void clear_forces() = 0;
  /// Eqs. 29, 36. Collective: a rank without points calls it with none. @return index of the first
  /// point that left the halo, or -1
  virtual std::ptrdiff_t spread(std::span<const Vec3> x, const ibm::Selection& selection,
                                std::span<const Vec3> f) = 0;
  /// Sum the forces of all ranks, collide, stream, bounce; leaves the new velocity on block and
  /// halo.
  virtual void step() = 0;
  /// Eqs. 32, 34. @return index of the first point that left the halo, or -1
  virtual std::ptrdiff_t interpolate(std::span<const Vec3> x, const ibm::Selection& selection,
                                     std::span<Vec3> u) const = 0;

  const lattice::Block& block() const { return at_.block; }
  const FluidParameters& parameters() const { return parameters_; }
  double viscosity() const { return parameters_.relaxation.viscosity(); }
  void set_body_force(const Vec3& force) {
    for (std::size_t d = 0; d < 3; ++d) parameters_.relaxation.force[d] = force[d];
  }

  /// Write to a file what the next step needs, or take it from there: populations, velocities and
  /// what a scheme remembers, as stored. A fluid written when `settled` goes on bit by bit as the
  /// one that wrote it; else, and on other ranks, up to round-off. Collective.
  /// @throws FileError with path and reason, maybe on one rank only
  virtual void save(const std::string& path) = 0;
  virtual void load(const std::string& path) = 0;
  /// Bytes of that file, on all ranks together.
  virtual double saved_bytes() const = 0;
  /// Whether all populations lie at their own nodes: after every second step.
  virtual bool settled() const = 0;

  bool has_vessel() const { return parameters_.vessel != nullptr; }
  /// Distance from the vessel's wall at a point of block or halo, linear between nodes.
  virtual WallDistance wall_distance(const Vec3& x) const = 0;
  /// This rank's fluid nodes: all, or those inside the vessel.
  virtual double fluid_nodes() const = 0;

  /// Memory of the populations (with all a scheme remembers), forces and velocities of this rank.
  virtual std::size_t bytes() const = 0;

  /// Density and velocity of the owned nodes, x fastest; solid nodes have density 1 and are at
  /// rest.
  virtual void copy_owned(std::span<double> rho, std::span<Vec3> u) = 0;
  struct Fastest {
    double speed = 0;           ///< not finite if any population of a node was not in the last step
    std::array<int, 3> node{};  ///< global
  };
  /// Largest |u| on the owned fluid nodes of this rank.
  virtual Fastest fastest() const = 0;
  double max_speed() const { return fastest().speed; }
  /// Sum of the velocity over the owned fluid nodes of this rank.
  virtual Vec3 total_velocity() const = 0;
  /// Mass of the owned nodes of this rank, less that of the fluid at rest at density one.
  virtual double excess_mass() = 0;
  /// Sum of e_i f_i over the owned nodes of this rank, after the last step's forces have acted in
  /// full (exponential scheme: before they have).
  virtual Vec3 momentum() = 0;
  /// Force spread on nodes of this rank in the last step (body force left out).
  virtual Vec3 node_force() const = 0;
  /// Part of the spread force that went to walls, in the last step, on this rank: to the low and
  /// high plate (a vessel: all to the first), and to both.
  const std::array<Vec3, 2>& wall_shares() const { return wall_shares_; }
  Vec3 wall_share() const { return wall_shares_[0] + wall_shares_[1]; }
  /// Momentum given to the low and high plate (a vessel: all to the first) in the last step, on
  /// this rank. Exponential scheme: of a steady flow.
  const std::array<Vec3, 2>& wall_momentum() const { return wall_momentum_; }
  /// The same of every step since the start. Populations stream in pairs of steps: what the first
  /// of a pair gave is known, and booked, with the second.
  struct WallBook {
    std::array<Vec3, 2> momentum{};
    long steps = 0;  ///< that are booked
  };
  const WallBook& wall_book() const { return wall_book_; }
  /// Go on from the book of a run that is resumed.
  void resume_wall_book(const WallBook& book) { wall_book_ = book; }

protected:
  FluidSolver(const Neighbourhood& at, const FluidParameters& parameters)
      : at_(at), parameters_(parameters) {}

  Neighbourhood at_;
  FluidParameters parameters_;
  std::array<Vec3, 2> wall_shares_{};
  std::array<Vec3, 2> wall_momentum_{};
  WallBook wall_book_;
};

/// @throws Error when a block is thinner than the coupling halo (too many ranks along an axis), or
/// parameters do not go together
std::unique_ptr<FluidSolver> make_fluid(const Neighbourhood& at, const FluidParameters& parameters);

}  // namespace hemomag::solver
