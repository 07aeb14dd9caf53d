#include "solver/crowd.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "membrane/area_volume.hpp"

namespace hemomag::solver {
namespace {

constexpr double largest_move = 0.03;  // of a vertex in a step, of the contacts' 0.2 um
// The kernels of the least instruction set: the same bits on every processor.
constexpr SimdLevel level = SimdLevel::sse2;

// FIRE's constants, as published.
constexpr double fire_grow = 1.1, fire_shrink = 0.5, fire_start_mix = 0.1, fire_mix_decay = 0.99;
constexpr int fire_patience = 5;

void list_cell(const CrowdModel& m, int first, membrane::EdgeList& edges,
               membrane::TriangleList& triangles, membrane::HingeList& hinges) {
  const auto& x = m.rest.x;
  for (std::size_t e = 0; e < m.topology.edges.size(); ++e) {
    const auto [a, b] = m.topology.edges[e];
    edges.add(first + a, first + b,
              membrane::make_spring(m.moduli.x0, m.rest_length[e] / m.moduli.x0, m.moduli.mu0,
                                    m.moduli.m));
  }
  triangles.start_cell();
  const auto at = [&](int v) { return x[static_cast<std::size_t>(v)]; };
  for (const auto& t : m.rest.triangles)
    triangles.add({first + t[0], first + t[1], first + t[2]}, {}, m.moduli.k_d,
                  0.5 * norm(membrane::twice_area_vector(at(t[0]), at(t[1]), at(t[2]))));
  for (const auto& h : m.topology.hinges) {
    const auto theta = membrane::make_hinge(at(h[0]), at(h[1]), at(h[2]), at(h[3])).theta;
    hinges.add({first + h[0], first + h[1], first + h[2], first + h[3]},
               m.moduli.flat_hinges ? membrane::Bending{m.moduli.k_b, 0, 1}
                                    : membrane::Bending{m.moduli.k_b, theta.sine, theta.cosine});
  }
}

Vec3 mean(std::span<const Vec3> x) {
  Vec3 sum;
  for (const Vec3& p : x) sum += p;
  return sum / static_cast<double>(x.size());
}

}  // namespace

Crowd::Crowd(std::vector<CrowdModel> models, const lattice::PeriodicBox& box,
             const CrowdContact& contact)
    : models_(std::move(models)), contacts_(contact, box) {
  double stiffest = 0;
  for (const CrowdModel& m : models_) {
    area0_.push_back(membrane::surface_area(m.rest));
    volume0_.push_back(membrane::enclosed_volume(m.rest));
    const double share = area0_.back() / static_cast<double>(m.rest.x.size());
    // A vertex meets about four others, as point and as corner.
    stiffest = std::max(stiffest, stiffest_mode(m) + 4 * contact.stiffness * share);
  }
  // Half of what the explicit step bears on the cells as they are at rest.
  time_step_ = 1 / std::sqrt(stiffest);
}

void Crowd::add(std::size_t model, std::span<const Vec3> x) {
  const CrowdModel& m = models_[model];
  const int first = static_cast<int>(x_.size());
  const int cell = static_cast<int>(members_.size());
  members_.push_back({model, x_.size()});
  list_cell(m, first, edges_, triangles_, hinges_);
  x_.insert(x_.end(), x.begin(), x.end());
  v_.resize(x_.size());
  f_.resize(x_.size());
  surfaces_.cell.insert(surfaces_.cell.end(), x.size(), cell);
  surfaces_.share.insert(surfaces_.share.end(), x.size(),
                         area0_[model] / static_cast<double>(x.size()));
  surfaces_.gap.insert(surfaces_.gap.end(), x.size(), m.vertex_gap);
  for (const auto& t : m.rest.triangles)
    surfaces_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  listed_ = false;
}

std::span<const Vec3> Crowd::x(std::size_t cell) const {
  const Member& m = members_[cell];
  return std::span(x_).subspan(m.first, models_[m.model].rest.x.size());
}

void Crowd::set_plates(double low, double high, double gap) { plates_ = Plates{low, high, gap}; }

void Crowd::set_wall(std::function<double(const Vec3&)> distance, double gap) {
  wall_ = std::move(distance);
  wall_gap_ = gap;
  listed_ = false;
}

void Crowd::set_scale(double scale) {
  for (std::size_t c = 0; c < members_.size(); ++c) {
    const std::size_t first = members_[c].first, count = x(c).size();
    const Vec3 centre = mean(x(c));
    for (std::size_t v = first; v < first + count; ++v)
      x_[v] = centre + (scale / scale_) * (x_[v] - centre);
  }
  scale_ = scale;
}

/// Largest eigenvalue of the energy's second derivatives about the rest mesh, by power iteration.
double Crowd::stiffest_mode(const CrowdModel& m) const {
  membrane::EdgeList edges;
  membrane::TriangleList triangles;
  membrane::HingeList hinges;
  list_cell(m, 0, edges, triangles, hinges);
  edges.finish(), triangles.finish(), hinges.finish();
  const double area0 = membrane::surface_area(m.rest), volume0 = membrane::enclosed_volume(m.rest);
  const std::size_t n = m.rest.x.size();
  const double h = 1e-4 * std::sqrt(area0 / static_cast<double>(n));
  std::vector<Vec3> along(n), x(n), f(n);
  for (std::size_t v = 0; v < n; ++v)  // some vector of every mode
    along[v] = {v % 2 ? 1.0 : -1.0, v % 3 ? 1.0 : -1.0, v % 5 ? 1.0 : -1.0};
  double stiffness = 0;
  for (int iteration = 0; iteration < 40; ++iteration) {
    double length = 0;
    for (const Vec3& d : along) length += norm2(d);
    length = std::sqrt(length);
    std::vector<Vec3> image(n);
    for (const double side : {-1.0, 1.0}) {
      for (std::size_t v = 0; v < n; ++v) x[v] = m.rest.x[v] + (side * h / length) * along[v];
      std::fill(f.begin(), f.end(), Vec3{});
      edges.add_forces(x, f, level);
      const auto g = triangles.geometry(0, x, level);
      triangles.add_forces(0,
                           {membrane::restoring(m.moduli.k_a, g.area, area0),
                            membrane::restoring(m.moduli.k_v, g.volume, volume0)},
                           x, f, level);
      hinges.add_forces(x, f, level);
      for (std::size_t v = 0; v < n; ++v) image[v] -= (0.5 * side / h) * f[v];
    }
    stiffness = 0;
    for (const Vec3& d : image) stiffness += norm2(d);
    stiffness = std::sqrt(stiffness);
    along.swap(image);
  }
  return stiffness;
}

void Crowd::refresh_lists() {
  if (listed_) {
    const double most = 0.25 * contacts_.contact().skin * contacts_.contact().skin;
    bool moved = false;
    for (std::size_t v = 0; v < x_.size() && !moved; ++v)
      moved = norm2(x_[v] - listed_at_[v]) > most;
    if (!moved) return;
  } else {
    edges_.finish(), triangles_.finish(), hinges_.finish();
  }
  contacts_.build(surfaces_, x_);
  list_walls();
  listed_at_ = x_;
  listed_ = true;
}

void Crowd::list_walls() {
  planes_.clear();
  if (!wall_) return;
  const double reach = wall_gap_ + contacts_.contact().skin;
  const double h = 1e-3 * reach;
  for (std::size_t v = 0; v < x_.size(); ++v) {
    const double d = wall_(x_[v]);
    if (d > reach) continue;
    Vec3 normal;
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 step;
      step[k] = h;
      normal[k] = wall_(x_[v] + step) - wall_(x_[v] - step);
    }
    planes_.push_back({v, normal / norm(normal), x_[v], d});
  }
}

void Crowd::membrane_forces() {
  std::span<const Vec3> x = x_;
  if (scale_ != 1) {  // the cell at full size has the same shape, and the same strains
    scaled_.resize(x_.size());
    for (std::size_t v = 0; v < x_.size(); ++v) scaled_[v] = x_[v] / scale_;
    x = scaled_;
  }
  if (const auto edge = edges_.add_forces(x, f_, level); edge >= 0)
    throw Error(
        "packing drew an edge of cell " +
        std::to_string(surfaces_.cell[static_cast<std::size_t>(edges_.vertex(0, edge))] + 1) +
        " out to its largest length");
  for (std::size_t c = 0; c < members_.size(); ++c) {
    const std::size_t m = members_[c].model;
    const auto g = triangles_.geometry(c, x, level);
    triangles_.add_forces(c,
                          {membrane::restoring(models_[m].moduli.k_a, g.area, area0_[m]),
                           membrane::restoring(models_[m].moduli.k_v, g.volume, volume0_[m])},
                          x, f_, level);
  }
  hinges_.add_forces(x, f_, level);
}

void Crowd::wall_forces() {
  const auto push = [&](std::size_t v, const Vec3& normal, double d, double gap) {
    const contact::SurfaceRepulsion law{contacts_.contact().stiffness * surfaces_.share[v],
                                        scale_ * gap};
    f_[v] += contact::force(law, d) * normal;
  };
  for (const WallPlane& p : planes_)
    push(p.vertex, p.normal, p.distance + dot(p.normal, x_[p.vertex] - p.at), wall_gap_);
  if (!plates_) return;
  for (std::size_t v = 0; v < x_.size(); ++v) {
    push(v, {0, 0, 1}, x_[v].z - plates_->low, plates_->gap);
    push(v, {0, 0, -1}, plates_->high - x_[v].z, plates_->gap);
  }
}

void Crowd::compute_forces() {
  refresh_lists();
  std::fill(f_.begin(), f_.end(), Vec3{});
  membrane_forces();
  contacts_.add_forces(surfaces_, x_, scale_, f_);
  wall_forces();
}

void Crowd::step(double damping, std::span<const Vec3> drift) {
  compute_forces();
  const double keep = 1 / (1 + damping * time_step_);
  for (std::size_t v = 0; v < x_.size(); ++v) {
    const Vec3 with = drift.empty() ? Vec3{} : drift[static_cast<std::size_t>(surfaces_.cell[v])];
    v_[v] = with + keep * (v_[v] + time_step_ * f_[v] - with);
    const double move = time_step_ * norm(v_[v]);
    if (move > largest_move) v_[v] *= largest_move / move;
    x_[v] += time_step_ * v_[v];
  }
}

double Crowd::fire_step() {
  compute_forces();
  if (fire_step_ == 0) fire_step_ = 0.25 * time_step_, fire_mix_ = fire_start_mix;
  double power = 0, v2 = 0, f2 = 0, largest2 = 0;
  for (std::size_t v = 0; v < x_.size(); ++v) {
    power += dot(f_[v], v_[v]);
    v2 += norm2(v_[v]);
    f2 += norm2(f_[v]);
    largest2 = std::max(largest2, norm2(f_[v]));
  }
  if (power > 0) {
    const double turn = f2 > 0 ? fire_mix_ * std::sqrt(v2 / f2) : 0;
    for (std::size_t v = 0; v < x_.size(); ++v) v_[v] = (1 - fire_mix_) * v_[v] + turn * f_[v];
    if (++fire_downhill_ > fire_patience) {
      fire_step_ = std::min(fire_grow * fire_step_, time_step_);
      fire_mix_ *= fire_mix_decay;
    }
  } else {
    std::fill(v_.begin(), v_.end(), Vec3{});
    fire_step_ = std::max(fire_shrink * fire_step_, 0.02 * time_step_);
    fire_mix_ = fire_start_mix;
    fire_downhill_ = 0;
  }
  for (std::size_t v = 0; v < x_.size(); ++v) {
    v_[v] += fire_step_ * f_[v];
    const double move = fire_step_ * norm(v_[v]);
    if (move > largest_move) v_[v] *= largest_move / move;
    x_[v] += fire_step_ * v_[v];
  }
  return std::sqrt(largest2);
}

void Crowd::stop() {
  std::fill(v_.begin(), v_.end(), Vec3{});
  fire_step_ = 0;
  fire_downhill_ = 0;
}

double Crowd::largest_change(const std::function<double(std::size_t)>& change) const {
  double most = 0;
  for (std::size_t c = 0; c < members_.size(); ++c) most = std::max(most, std::fabs(change(c)));
  return most;
}

double Crowd::area_change() const {
  return largest_change([&](std::size_t c) {
    return triangles_.geometry(c, x_, level).area / (area0_[members_[c].model] * scale_ * scale_) -
           1;
  });
}

double Crowd::volume_change() const {
  return largest_change([&](std::size_t c) {
    return triangles_.geometry(c, x_, level).volume /
               (volume0_[members_[c].model] * scale_ * scale_ * scale_) -
           1;
  });
}

}  // namespace hemomag::solver
