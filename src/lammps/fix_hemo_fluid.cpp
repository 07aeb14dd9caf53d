#include "lammps/fix_hemo_fluid.h"

#include <cmath>
#include <span>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

#include "io/surface_file.hpp"
#include "lammps/accident.hpp"
#include "lammps/compat.hpp"
#include "lammps/fix_hemo_drag.h"
#include "lammps/fix_state.hpp"
#include "lattice/surface_vessel.hpp"
#include "solver/flow_controller.hpp"
#include "solver/fluid_solver.hpp"

using namespace LAMMPS_NS;
using hemomag::Vec3;
using hemomag::solver::FluidSolver;

FixHemoFluid::FixHemoFluid(LAMMPS* lmp, int narg, char** arg)
    : Fix(lmp, narg, arg), parameters_(std::make_unique<hemomag::solver::FluidParameters>()) {
  scalar_flag = vector_flag = restart_global = 1;
  size_vector = 15;
  global_freq = 1;
  extscalar = extvector = 0;  // totals: not to be divided by the number of atoms
  for (int at = 3; at < narg;) at = parse_keyword(narg, arg, at);
  check_scheme();
  if (driven_axis_ >= 0)
    controller_ = std::make_unique<hemomag::solver::FlowController>(
        mean_velocity_, parameters_->relaxation.force[driven_axis_]);
}

FixHemoFluid::~FixHemoFluid() = default;

/// What tau and the scheme allow is known once both are.
void FixHemoFluid::check_scheme() {
  auto& r = parameters_->relaxation;
  const bool exponential = scheme_ == "exponential";
  const double least = exponential ? 0.0 : 0.5;
  if (!(r.tau > least))
    error->all(FLERR, "fix hemo/fluid: tau = " + std::to_string(r.tau) +
                          " is unstable, need tau > " + (exponential ? "0" : "0.5") +
                          " with scheme " + scheme_ + " (raise the viscosity or lower dt)");
  if (scheme_ == "bgk") r.magic = hemomag::fluid::Relaxation::bgk(r.tau).magic;
  if (exponential) r.collision = hemomag::fluid::Collision::exponential;
}

int FixHemoFluid::parse_keyword(int narg, char** arg, int at) {
  const std::string key = arg[at++];
  const auto next = [&]() -> const char* {
    if (at >= narg) error->all(FLERR, "fix hemo/fluid: " + key + " needs more values");
    return arg[at++];
  };
  const auto number = [&] { return utils::numeric(FLERR, next(), false, lmp); };
  const auto vector = [&] {
    const double x = number(), y = number(), z = number();
    return Vec3{x, y, z};
  };
  const auto axis = [&] {
    const std::string name = next();
    if (name != "x" && name != "y" && name != "z")
      error->all(FLERR, "fix hemo/fluid: " + key + " " + name + ": the axis must be x, y or z");
    return name[0] - 'x';
  };
  const auto expect = [&](const char* word) {
    if (std::string(next()) != word)
      error->all(
          FLERR,
          std::string("fix hemo/fluid: plates AXIS lower VX VY VZ upper VX VY VZ is expected"));
  };
  auto& p = *parameters_;
  if (key == "tau") {
    p.relaxation.tau = number();
  } else if (key == "scheme") {
    scheme_ = next();
    if (scheme_ != "trt" && scheme_ != "bgk" && scheme_ != "exponential")
      error->all(FLERR, "fix hemo/fluid: scheme " + scheme_ +
                            " is not available; accepted: trt, bgk, exponential");
  } else if (key == "precision") {
    const std::string precision = next();
    if (precision != "double" && precision != "single")
      error->all(FLERR, "fix hemo/fluid: precision " + precision +
                            " is unknown; accepted: double, single");
    p.precision = precision == "single" ? hemomag::solver::Precision::single_
                                        : hemomag::solver::Precision::double_;
  } else if (key == "magic") {
    p.relaxation.magic = number();
    if (p.relaxation.magic <= 0)
      error->all(FLERR, std::string("fix hemo/fluid: magic must be > 0"));
  } else if (key == "kernel") {
    hemomag::lammps::or_fail(lmp, FLERR, [&] { p.kernel = hemomag::ibm::delta_kernel(next()); });
  } else if (key == "plates") {
    p.plate_axis = axis();
    expect("lower");
    p.plate_velocity[0] = vector();
    expect("upper");
    p.plate_velocity[1] = vector();
  } else if (key == "tube") {
    const int along = axis();
    Vec3 centre;
    for (std::size_t d = 0; d < 3; ++d)
      if (static_cast<int>(d) != along) centre[d] = number();
    const double radius = number();
    if (!(radius > 0)) error->all(FLERR, std::string("fix hemo/fluid: tube needs a radius > 0"));
    p.vessel = std::make_shared<hemomag::lattice::Tube>(along, centre, radius);
  } else if (key == "surface") {
    const std::string file = next();
    const double unit = number();
    if (!(unit > 0)) error->all(FLERR, std::string("fix hemo/fluid: surface needs a unit > 0"));
    hemomag::lammps::or_fail(lmp, FLERR, [&] {
      auto surface = hemomag::io::read_surface(file);
      for (Vec3& x : surface.points) x = unit * x;
      p.vessel = std::make_shared<hemomag::lattice::SurfaceVessel>(surface);
    });
  } else if (key == "curved") {
    const std::string rule = next();
    if (rule != "interpolated" && rule != "halfway")
      error->all(FLERR,
                 "fix hemo/fluid: curved " + rule + " is unknown; accepted: interpolated, halfway");
    p.wall_rule = rule == "halfway" ? hemomag::fluid::WallRule::halfway
                                    : hemomag::fluid::WallRule::interpolated;
  } else if (key == "mean_velocity") {
    driven_axis_ = axis();
    mean_velocity_ = number();
  } else if (key == "force") {
    const Vec3 g = vector();
    for (std::size_t d = 0; d < 3; ++d) p.relaxation.force[d] = g[d];
  } else if (key == "initial") {
    const std::string how = next();
    if (how != "rest" && how != "linear")
      error->all(FLERR, "fix hemo/fluid: initial " + how + " is unknown; accepted: rest, linear");
    initial_ = how == "rest" ? Initial::rest : Initial::linear;
  } else {
    error->all(FLERR, "fix hemo/fluid: unknown keyword " + key +
                          "; accepted: tau, scheme, magic, precision, kernel, plates, tube, "
                          "surface, curved, force, mean_velocity, initial");
  }
  return at;
}

int FixHemoFluid::setmask() { return FixConst::POST_FORCE; }

void FixHemoFluid::init() {
  require_place_in_script();
  if (!solver_) create_solver();
  one_way_bits_ = 0;
  if (const auto* drag = hemomag::lammps::find_fix<FixHemoDrag>(lmp, "hemo/drag"))
    if (!drag->feedback()) one_way_bits_ = drag->groupbit;
}

void FixHemoFluid::require_place_in_script() const {
  if (update->dt != 1.0)
    error->all(FLERR, std::string("fix hemo/fluid: lattice units need `timestep 1.0`"));
  if (!force->newton_pair || !force->newton_bond)
    error->all(FLERR, std::string("fix hemo/fluid needs `newton on`"));
  if (comm->layout != Comm::LAYOUT_UNIFORM || comm->style != 0)
    error->all(FLERR, std::string(
                          "fix hemo/fluid: the fluid needs equal bricks; load balancing sees atoms "
                          "only and is refused"));
  bool after = false;
  for (int i = 0; i < modify->nfix; ++i) {
    if (modify->fix[i] == this)
      after = true;
    else if (after && (modify->fmask[i] & FixConst::POST_FORCE))
      error->all(FLERR,
                 "fix hemo/fluid must be the last fix that adds forces: define it after fix " +
                     std::string(modify->fix[i]->id));
  }
}

void FixHemoFluid::create_solver() {
  hemomag::solver::Neighbourhood at;
  at.comm = world;
  at.rank = comm->me;
  if (domain->triclinic) error->all(FLERR, std::string("fix hemo/fluid needs an orthogonal box"));
  for (int d = 0; d < 3; ++d) {
    const double nodes = domain->boxhi[d] - domain->boxlo[d];
    const int n = static_cast<int>(std::lround(nodes));
    if (domain->boxlo[d] != 0.0 || std::fabs(nodes - n) > 1e-9 || n < 1)
      error->all(
          FLERR,
          std::string("fix hemo/fluid: the box must run from 0 to a whole number of nodes along ") +
              "xyz"[d]);
    const bool plate = parameters_->plate_axis == d;
    if (plate == (domain->periodicity[d] != 0))
      error->all(FLERR, std::string("fix hemo/fluid: axis ") + "xyz"[d] +
                            (plate ? " has plates and must have `boundary f`"
                                   : " has no plates and must be periodic"));
    at.block.global[d] = n;
    at.block.begin[d] = hemomag::lattice::first_node(n, comm->procgrid[d], comm->myloc[d]);
    at.block.size[d] =
        hemomag::lattice::first_node(n, comm->procgrid[d], comm->myloc[d] + 1) - at.block.begin[d];
    for (int side = 0; side < 2; ++side) {
      const bool end = comm->myloc[d] == (side == 0 ? 0 : comm->procgrid[d] - 1);
      at.neighbour[d][side] = plate && end ? MPI_PROC_NULL : comm->procneigh[d][side];
    }
  }
  parameters_->reach_beyond_block = 0.5 * neighbor->skin;
  hemomag::lammps::or_fail(lmp, FLERR,
                           [&] { solver_ = hemomag::solver::make_fluid(at, *parameters_); });

  const int axis = parameters_->plate_axis;
  const Vec3 low = parameters_->plate_velocity[0], high = parameters_->plate_velocity[1];
  solver_->initialise([&](const Vec3& position) {
    std::pair<Vec3, hemomag::fluid::VelocityGradient> flow;
    if (initial_ == Initial::linear && axis >= 0) {
      const auto a = static_cast<std::size_t>(axis);
      flow.second[a] = (high - low) / at.block.global[axis];
      flow.first = low + position[a] * flow.second[a];
    }
    return flow;
  });
}

void FixHemoFluid::setup(int vflag) {
  if (lacks_populations_)
    error->all(FLERR,
               std::string("fix hemo/fluid: the restart file does not hold the fluid itself; "
                           "accepted: fix hemo/checkpoint ... resume DIR before the run"));
  // A second `run` continues where the first stopped: this step's fluid has been done already.
  if (done_step_ != update->ntimestep) post_force(vflag);
}

void FixHemoFluid::post_force(int) {
  // Every rank spreads, also one without atoms: the halo sum that follows is collective.
  const auto n = static_cast<std::size_t>(atom->nlocal);
  const auto vectors = [n](double** rows) {
    return std::span<const Vec3>(n > 0 ? reinterpret_cast<const Vec3*>(rows[0]) : nullptr, n);
  };
  solver_->clear_forces();
  const auto lost = solver_->spread(vectors(atom->x), {{atom->mask, n}, groupbit, one_way_bits_},
                                    vectors(atom->f));
  if (lost >= 0) lost_point(lost, "spreading its force");
  solver_->step();
  hold_mean_velocity();
  done_step_ = update->ntimestep;
}

/// Renew the body force now and then: the sum over all ranks costs more than it can change in a
/// few steps.
void FixHemoFluid::hold_mean_velocity() {
  constexpr int every = 10;
  if (!controller_ || update->ntimestep % every != 0) return;
  const auto d = static_cast<std::size_t>(driven_axis_);
  const double mine[2] = {solver_->total_velocity()[d], solver_->fluid_nodes()};
  double all[2];
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_SUM, world);
  const double* start = parameters_->relaxation.force;
  Vec3 force{start[0], start[1], start[2]};
  force[d] = controller_->force(all[0] / all[1], every);
  solver_->set_body_force(force);
}

void FixHemoFluid::velocity_at_atoms(int bits, double** v) {
  const auto n = static_cast<std::size_t>(atom->nlocal);
  if (n == 0) return;
  const std::span<const Vec3> x(reinterpret_cast<const Vec3*>(atom->x[0]), n);
  const auto lost =
      solver_->interpolate(x, {{atom->mask, n}, bits, 0}, {reinterpret_cast<Vec3*>(v[0]), n});
  if (lost >= 0) lost_point(lost, "reading the fluid's velocity");
}

void FixHemoFluid::lost_point(long i, const char* doing) const {
  const double* x = atom->x[i];
  hemomag::lammps::accident(lmp, "fix hemo/fluid",
                            "atom " + std::to_string(atom->tag[i]) + " at " + std::to_string(x[0]) +
                                " " + std::to_string(x[1]) + " " + std::to_string(x[2]) +
                                " is outside the channel or not finite while " + doing +
                                " (forces too strong for the time step?)");
}

FluidSolver& FixHemoFluid::solver() {
  if (!solver_) error->all(FLERR, std::string("fix hemo/fluid is not initialised yet"));
  return *solver_;
}

double FixHemoFluid::viscosity() const { return parameters_->relaxation.viscosity(); }

double FixHemoFluid::point_radius() const {
  const auto& r = parameters_->relaxation;
  return r.collision == hemomag::fluid::Collision::exponential
             ? hemomag::ibm::exponential_radius(parameters_->kernel, r.tau)
             : hemomag::ibm::hydrodynamic_radius(parameters_->kernel, r.magic);
}

double FixHemoFluid::compute_scalar() {
  double mine = solver_->excess_mass(), all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  const auto& n = solver_->block().global;
  return all + static_cast<double>(n[0]) * n[1] * n[2];
}

/// 1-3 fluid momentum, 4-6 force on nodes, 7-9 plates' share of the spread force, 10-12 and 13-15
/// momentum that bounce-back gave to the low and to the high plate, all in the last step.
double FixHemoFluid::compute_vector(int k) {
  const auto d = static_cast<std::size_t>(k % 3);
  Vec3 mine;
  switch (k / 3) {
  case 0:
    mine = solver_->momentum();
    break;
  case 1:
    mine = solver_->node_force();
    break;
  case 2:
    mine = solver_->wall_share();
    break;
  default:
    mine = solver_->wall_momentum()[static_cast<std::size_t>(k / 3 - 3)];
  }
  double sum = 0;
  MPI_Allreduce(&mine[d], &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  return sum;
}

double FixHemoFluid::memory_usage() {
  return solver_ ? static_cast<double>(solver_->bytes()) : 0.0;
}

/// What the fluid knows besides its nodes: the step it has done, the force that drives it and what
/// it gave to plates.
void FixHemoFluid::write_restart(FILE* file) {
  const double* g = solver_->parameters().relaxation.force;
  const auto& book = solver().wall_book();
  std::vector<double> state{
      static_cast<double>(done_step_), g[0], g[1], g[2], controller_ ? controller_->integral() : 0,
      static_cast<double>(book.steps)};
  const auto& [low, high] = book.momentum;
  const auto momenta =
      hemomag::lammps::of_each_rank(world, {low.x, low.y, low.z, high.x, high.y, high.z});
  state.insert(state.end(), momenta.begin(), momenta.end());
  hemomag::lammps::write_state(file, comm->me, state);
}

void FixHemoFluid::restart(char* buffer) {
  hemomag::lammps::StateReader state(buffer);
  done_step_ = state.whole<bigint>();
  for (double& g : restored_force_) g = state.number();
  const double integral = state.number();
  if (controller_) controller_->set_integral(integral);
  const double booked = state.number();
  restored_book_ = state.own(world, 6);
  restored_book_.insert(restored_book_.begin(), booked);
  lacks_populations_ = true;
}

void FixHemoFluid::load(const std::string& path) {
  hemomag::lammps::or_fail(lmp, FLERR, [&] { solver().load(path); });
  if (lacks_populations_) {
    solver().set_body_force({restored_force_[0], restored_force_[1], restored_force_[2]});
    const auto& b = restored_book_;
    solver().resume_wall_book(
        {{Vec3{b[1], b[2], b[3]}, Vec3{b[4], b[5], b[6]}}, static_cast<long>(b[0])});
  }
  lacks_populations_ = false;
}
