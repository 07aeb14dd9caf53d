#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/vec3.hpp"
#include "lattice/near_points.hpp"
#include "membrane/network.hpp"
#include "membrane/topology.hpp"
#include "membrane/whole_cell.hpp"
#include "solver/crowd_contacts.hpp"

namespace hemomag::solver {

/// What the cells of one kind have in common. Any consistent units (um and pN in practice).
struct CrowdModel {
  membrane::TriangleMesh rest;
  membrane::Topology topology;
  std::vector<double> rest_length;  ///< [n_e]
  membrane::Moduli moduli;
  double vertex_gap = 0;  ///< between vertices of different cells
};

/// Many whole cells without a fluid, on one processor: their membranes, their contacts and walls.
/// For making starting states, not for the flow. Vertices have mass one, so that time is in the
/// units that follow. The same calls give the same bits whatever instruction set the processor has.
class Crowd {
public:
  Crowd(std::vector<CrowdModel> models, const lattice::PeriodicBox& box,
        const CrowdContact& contact);

  /// @param x  [n_v] of the model, in one piece
  void add(std::size_t model, std::span<const Vec3> x);
  std::size_t cells() const { return members_.size(); }
  std::span<const Vec3> x(std::size_t cell) const;

  /// Cells keep `gap` from planes at z = low and high, which may move between steps.
  void set_plates(double low, double high, double gap);
  /// Cells keep `gap` from a wall at rest.
  /// @param distance  of a point to it, positive where the cells are
  void set_wall(std::function<double(const Vec3&)> distance, double gap);

  /// Cells at `scale` times their rest size, of the same shape; those that are there are scaled
  /// about their centres.
  void set_scale(double scale);

  /// A stable time step for membranes and contacts.
  double time_step() const { return time_step_; }

  /// One damped step: dv/dt = f - damping (v - drift of the cell).
  /// @param drift  [cells], or empty for none
  void step(double damping, std::span<const Vec3> drift = {});

  /// One step towards the least energy by FIRE (Bitzek et al., PRL 97:170201, 2006).
  /// @return the largest force on a vertex
  double fire_step();
  /// Forget velocities and what FIRE has learnt.
  void stop();

  /// Largest |A/A0 - 1| and |V/V0 - 1| of a cell.
  double area_change() const;
  double volume_change() const;

private:
  struct Member {
    std::size_t model, first;
  };
  struct Plates {
    double low, high, gap;
  };
  /// The wall near a vertex, flat as far as it may move: distance normal.(x - at) + distance.
  struct WallPlane {
    std::size_t vertex;
    Vec3 normal, at;
    double distance;
  };

  void compute_forces();
  void membrane_forces();
  void wall_forces();
  void refresh_lists();
  void list_walls();
  double stiffest_mode(const CrowdModel& model) const;
  double largest_change(const std::function<double(std::size_t)>& change) const;

  std::vector<CrowdModel> models_;
  std::vector<Member> members_;
  CrowdSurfaces surfaces_;
  CrowdContacts contacts_;
  membrane::EdgeList edges_;
  membrane::TriangleList triangles_;
  membrane::HingeList hinges_;
  std::vector<double> area0_, volume0_;  // of models

  std::optional<Plates> plates_;
  std::function<double(const Vec3&)> wall_;
  double wall_gap_ = 0;
  std::vector<WallPlane> planes_;

  std::vector<Vec3> x_, v_, f_, scaled_, listed_at_;
  bool listed_ = false;
  double scale_ = 1, time_step_ = 0;
  double fire_step_ = 0, fire_mix_ = 0;
  int fire_downhill_ = 0;
};

}  // namespace hemomag::solver
