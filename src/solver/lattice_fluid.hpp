#pragma once
#include <vector>

#include "base/aligned.hpp"
#include "base/simd.hpp"
#include "fluid/exponential_walls.hpp"
#include "fluid/plates.hpp"
#include "fluid/sweep.hpp"
#include "fluid/wall_ghosts.hpp"
#include "lattice/node_layout.hpp"
#include "solver/fluid_solver.hpp"
#include "solver/halo_exchange.hpp"

namespace hemomag::solver {

/// The fluid with populations, forces and velocities stored as Real.
///
/// While messages are under way the interior is swept: the nodes that no message concerns. Where
/// ghosts along x are needed by every row (several ranks or plates along x) and in vessels there is
/// no such interior.
template <class Real> class LatticeFluid final : public FluidSolver {
public:
  LatticeFluid(const Neighbourhood& at, const FluidParameters& parameters);
  LatticeFluid(const LatticeFluid&) = delete;  // its halo exchange looks at its own neighbourhood
  LatticeFluid& operator=(const LatticeFluid&) = delete;

  void initialise(const std::function<Flow(const Vec3&)>& field) override;
  void clear_forces() override;
  std::ptrdiff_t spread(std::span<const Vec3> x, const ibm::Selection& selection,
                        std::span<const Vec3> f) override;
  void step() override;
  std::ptrdiff_t interpolate(std::span<const Vec3> x, const ibm::Selection& selection,
                             std::span<Vec3> u) const override;

  WallDistance wall_distance(const Vec3& x) const override;
  double fluid_nodes() const override;
  std::size_t bytes() const override;
  void copy_owned(std::span<double> rho, std::span<Vec3> u) override;
  Fastest fastest() const override;
  void save(const std::string& path) override;
  void load(const std::string& path) override;
  double saved_bytes() const override;
  bool settled() const override { return next_ == fluid::Pass::local; }
  Vec3 total_velocity() const override;
  double excess_mass() override;
  Vec3 momentum() override;
  Vec3 node_force() const override;

private:
  using Layout = lattice::NodeLayout;
  using NodeBox = lattice::NodeBox;

  void make_walls();
  void start_exponential();
  double fraction_in_fluid(int x, int y, int z, int direction) const;
  double excess_density(std::ptrdiff_t at) const;
  bool wet(std::ptrdiff_t node) const { return !distance_ || distance_[node] > Real(0); }
  template <class Visit> void for_each_fluid_row(Visit visit) const;

  void reduce_forces();
  void sum_forces_home();
  void clear_force_halo();
  void exchange_velocity(int first_axis);
  void exchange_sources(int first_axis);
  void send_populations_forward();
  void send_populations_home();
  using PlateRule = Vec3 (*)(const fluid::Plate&, const fluid::Populations<Real>&, const Layout&,
                             double);
  using LinkRule = Vec3 (fluid::WallLinks<Real>::*)(const fluid::Populations<Real>&, double) const;
  std::array<Vec3, 2> bounce(PlateRule plate_rule, LinkRule link_rule);
  std::array<Vec3, 2> bounce_before_shift();
  std::array<Vec3, 2> bounce_after_shift();
  std::array<Vec3, 2> reflect_source(int sense);
  void book_wall_momentum(const std::array<Vec3, 2>& bounced, const std::array<Vec3, 2>& reflected);
  void plan_interior(bool shift);
  void sweep(const NodeBox& box);
  void sweep_shell();
  void sweep_meanwhile();
  void wrap_rows_home();
  fluid::SweepFields<Real> sweep_fields(const NodeBox& box);
  template <class Visit> void for_each_population(Visit visit);

  NodeBox with_halo(int axes_done, int halo) const;
  struct Faces {
    NodeBox whole, ghost_low, first, last, ghost_high;
  };
  Faces faces(int axis, int width) const;
  std::array<Real*, 5> crossing(int axis, int sense) const;
  bool exponential() const {
    return parameters_.relaxation.collision == fluid::Collision::exponential;
  }

  SimdLevel simd_ = simd_level();
  Layout f_layout_, n_layout_;
  AlignedArray<Real> f_storage_, force_storage_, u_storage_, distance_storage_;
  fluid::Populations<Real> f_{};
  fluid::NodeVector<Real> force_{}, u_{};
  fluid::SourceNumbers<Real> last_{}, present_{};  // exponential scheme only
  Real* distance_ = nullptr;                       // at node (0, 0, 0); vessels only
  HaloExchange<Real> halo_;
  std::vector<fluid::Plate> plates_;
  fluid::WallLinks<Real> links_;
  fluid::WallGhosts<Real> ghosts_;
  bool wraps_x_ = false;  // this rank is its own neighbour along x: the sweep keeps those ghosts
  fluid::Pass next_ = fluid::Pass::local;
  std::array<Vec3, 2> reflected_before_{};  // what the last step gave to walls by reflect_source
  bool forces_clear_ = true;
  NodeBox interior_;            // not yet swept in this step
  int interior_parts_ = 0;      // exchanges that remain to work behind
  std::vector<NodeBox> swept_;  // in this step
};

}  // namespace hemomag::solver
