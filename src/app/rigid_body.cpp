#include "app/rigid_body.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace hemomag::app {
namespace {

constexpr double blob = 0.3;  // of the vertex spacing: the layer is smooth but not yet thick

double spacing(const membrane::TriangleMesh& mesh) {
  return std::sqrt(membrane::surface_area(mesh) / static_cast<double>(mesh.x.size()));
}

Eigen::Vector3d vector(const Vec3& a) { return {a.x, a.y, a.z}; }

/// Omega x r = turn(r) Omega.
Eigen::Matrix3d turn(const Eigen::Vector3d& r) {
  Eigen::Matrix3d m;
  m << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  return m;
}

}  // namespace

double JefferyOrbit::period() const { return 2 * std::numbers::pi * (r + 1 / r); }

JefferyOrbit rigid_orbit(const membrane::TriangleMesh& mesh) {
  using Eigen::Index;
  const auto n = static_cast<Index>(mesh.x.size());
  const auto at = [&](Index v) { return vector(mesh.x[static_cast<std::size_t>(v)]); };
  const double e2 = std::pow(blob * spacing(mesh), 2);
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  // Unknowns: forces of the vertices on the fluid, velocity U, angular velocity Omega. Equations:
  // sum_j G_ij f_j - U - Omega x x_i = -v(x_i), sum f = 0, sum x x f = 0. Unit viscosity.
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * n + 6, 3 * n + 6);
  Eigen::MatrixXd v = Eigen::MatrixXd::Zero(3 * n + 6, 2);
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      const Eigen::Vector3d r = at(i) - at(j);
      const double r2 = r.squaredNorm();
      a.block<3, 3>(3 * i, 3 * j) = ((r2 + 2 * e2) * one + r * r.transpose()) /
                                    (8 * std::numbers::pi * std::pow(r2 + e2, 1.5));
    }
    a.block<3, 3>(3 * j, 3 * n) = -one;
    a.block<3, 3>(3 * j, 3 * n + 3) = -turn(at(j));
    a.block<3, 3>(3 * n, 3 * j) = one;
    a.block<3, 3>(3 * n + 3, 3 * j) = -turn(at(j));
    v(3 * j + 1, 0) = -at(j).z();  // v_y = z: the axis along the gradient
    v(3 * j + 2, 1) = -at(j).y();  // v_z = y: the axis along the flow
  }
  const Eigen::MatrixXd solution = a.partialPivLu().solve(v);
  const double slow = std::fabs(solution(3 * n + 3, 0)), fast = std::fabs(solution(3 * n + 3, 1));
  return {std::sqrt(slow / fast)};
}

JefferyOrbit rigid_orbit(const membrane::TriangleMesh& coarse, const membrane::TriangleMesh& fine) {
  const double h = spacing(coarse), h_fine = spacing(fine);
  const double r = rigid_orbit(coarse).r, r_fine = rigid_orbit(fine).r;
  return {r_fine + (r_fine - r) * h_fine / (h - h_fine)};
}

}  // namespace hemomag::app
