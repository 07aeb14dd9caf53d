#include "fluid/equilibrium.hpp"

#include "lattice/d3q19.hpp"

namespace hemomag::fluid {

std::array<double, 19> populations(double rho, const Vec3& u, const VelocityGradient& grad_u,
                                   double tau) {
  using namespace lattice::d3q19;
  const double divergence = grad_u[0].x + grad_u[1].y + grad_u[2].z;
  std::array<double, 19> g{};
  for (int i = 0; i < Q; ++i) {
    const Vec3 c{static_cast<double>(e[i][0]), static_cast<double>(e[i][1]),
                 static_cast<double>(e[i][2])};
    const double cu = dot(c, u);
    const double strain = dot(c, c.x * grad_u[0] + c.y * grad_u[1] + c.z * grad_u[2]);
    g[i] = w[i] * ((rho - 1) + rho * (3 * cu + 4.5 * cu * cu - 1.5 * norm2(u)) -
                   rho * tau * (3 * strain - divergence));
  }
  return g;
}

}  // namespace hemomag::fluid
