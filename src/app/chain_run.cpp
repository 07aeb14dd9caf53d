#include "app/chain_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/published.hpp"

namespace hemomag::app {
namespace {

using std::numbers::pi;

constexpr double a = 1;       // node spacings: under the kernel's radius, 1.356
constexpr double kappa = 60;  // as the table's
constexpr double tau = 1.5;   // the longest step with a good viscosity
constexpr double viscosity = (tau - 0.5) / 3;
constexpr double look = 0.017;  // rad
constexpr double far = 3 * a;   // 1.5 diameters

int side_of(const ChainRun::Options& o) {
  return static_cast<int>(std::ceil(o.box * 2 * a * o.carriers));
}

/// The middle of the box, off the nodes.
Vec3 middle(int side) {
  const int node = side / 2;
  return {node + 0.23, node + 0.41, node + 0.12};
}

/// In line with the field, touching, hardly disturbed.
std::vector<Vec3> straight(const ChainRun::Options& o) {
  std::vector<Vec3> x;
  x.reserve(static_cast<std::size_t>(o.carriers));
  for (int k = 0; k < o.carriers; ++k)
    x.push_back(middle(side_of(o)) +
                Vec3{2 * a * (k - 0.5 * (o.carriers - 1)), 1e-4 * std::sin(7.1 * k), 0});
  return x;
}

double omega_of(const ChainRun::Options& o) {
  return o.reynolds * viscosity / (2 * a * a * o.carriers);
}

CarrierRun::Setup setup_of(const ChainRun::Options& o) {
  // w = omega 6 pi eta a^2/F0 with F0 = 3 m^2/(4 pi a^4) (Eq. 45).
  const double F0 =
      omega_of(o) * 6 * pi * viscosity * a * a / (o.speed * critical_frequency(o.carriers));
  const double m = std::sqrt(F0 * 4 * pi * a * a * a * a / 3);
  const int side = side_of(o);
  CarrierRun::Setup s;
  s.nodes = {side, side, side};
  s.radii = {a};
  s.x = straight(o);
  s.pair = format("hemo/dipole %.17g", 1.2 * 2 * a * o.carriers);
  s.pair_coeff = format("* * %.17g soft %g", 2 * a, kappa);
  s.forces = {format("fix field all hemo/field susceptibility 1 1 rotating xy %.17g %.17g", m,
                     omega_of(o) / (2 * pi))};
  s.fluid = format("tau %g", tau);
  return s;
}

}  // namespace

ChainRun::ChainRun(const Options& o)
    : carriers_(o.carriers), side_(side_of(o)), omega_(omega_of(o)),
      stride_(std::max(1, static_cast<int>(look / omega_))), run_(setup_of(o)), x_(straight(o)) {
  run_.run(0);
}

void ChainRun::advance() {
  run_.command("run " + std::to_string(stride_) + " pre no post no");
  steps_ += stride_;
  x_ = run_.x();
}

double ChainRun::field_angle() const { return omega_ * static_cast<double>(steps_); }

double ChainRun::turns() const { return field_angle() / (2 * pi); }

double ChainRun::tip_speed() const { return omega_ * carriers_ * a; }

double ChainRun::lag() const {
  const Vec3 line = x_.back() - x_.front();
  const Vec3 field{std::cos(field_angle()), std::sin(field_angle()), 0};
  return 180 / pi * std::acos(std::min(1.0, std::fabs(dot(line, field)) / norm(line)));
}

bool ChainRun::broken() const {
  if (lag() > 87) return true;
  for (std::size_t k = 0; k + 1 < x_.size(); ++k)
    if (norm(x_[k + 1] - x_[k]) > far) return true;
  return false;
}

std::array<double, 2> ChainRun::turned_ends() const {
  const auto bond = [&](std::size_t k) { return x_[k + 1] - x_[k]; };
  const std::size_t last = x_.size() - 2, mid = x_.size() / 2;
  const Vec3 centre = bond(mid - 1) + bond(mid);
  std::array<double, 2> angle{};
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
    const Vec3 b = bond(end == 0 ? 0 : last);
    angle[end] = 180 / pi * std::atan2(cross(centre, b).z, dot(centre, b));
  }
  return angle;
}

double ChainRun::bend() const {
  const auto [first, last] = turned_ends();
  return std::max(std::fabs(first), std::fabs(last));
}

double ChainRun::s_shape() const {
  const auto [first, last] = turned_ends();
  return first * last > 0 ? std::min(std::fabs(first), std::fabs(last)) : 0;
}

int ChainRun::fragments() const {
  std::vector<std::size_t> group(x_.size());
  for (std::size_t k = 0; k < x_.size(); ++k) group[k] = k;
  for (std::size_t i = 0; i < x_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (group[i] == group[j] || norm(x_[i] - x_[j]) > far) continue;
      const std::size_t from = group[i], to = group[j];
      for (std::size_t& g : group)
        if (g == from) g = to;
    }
  std::sort(group.begin(), group.end());
  return static_cast<int>(std::unique(group.begin(), group.end()) - group.begin());
}

std::vector<Vec3> ChainRun::flow_in_plane() {
  const auto u = run_.fluid_velocity();
  const auto plane = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  const auto first = static_cast<std::ptrdiff_t>(plane * static_cast<std::size_t>(side_ / 2));
  return {u.begin() + first, u.begin() + first + static_cast<std::ptrdiff_t>(plane)};
}

}  // namespace hemomag::app
