#pragma once
#include <array>
#include <vector>

#include "lattice/d3q19.hpp"

namespace hemomag::test {

/// The scalar oracle: D3Q19 TRT with Guo forcing on a periodic box, optionally closed by plates
/// along z, written from the equations with two copies of the populations. Slow and plain on
/// purpose.
class ReferenceFluid {
public:
  using Populations = std::array<double, 19>;
  ReferenceFluid(std::array<int, 3> n, double tau, double magic)
      : size(n), f(nodes()), force(nodes()), u(nodes()), omega_plus_(1 / tau),
        omega_minus_(1 / (0.5 + magic / (tau - 0.5))) {}

  std::size_t nodes() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  std::size_t index(int x, int y, int z) const {
    const auto wrap = [](int i, int n) { return (i % n + n) % n; };
    return static_cast<std::size_t>((wrap(z, size[2]) * size[1] + wrap(y, size[1])) * size[0] +
                                    wrap(x, size[0]));
  }

  void step() {
    std::vector<Populations> post(nodes());
    for (std::size_t n = 0; n < nodes(); ++n) post[n] = collide(n);
    for (int z = 0; z < size[2]; ++z)
      for (int y = 0; y < size[1]; ++y)
        for (int x = 0; x < size[0]; ++x)
          for (std::size_t i = 0; i < 19; ++i) {
            const auto& c = lattice::d3q19::e[i];
            const int from = z - c[2];
            if (plates && (from < 0 || from >= size[2])) {
              const auto& wall = from < 0 ? lower : upper;
              const double cu = c[0] * wall[0] + c[1] * wall[1] + c[2] * wall[2];
              f[index(x, y, z)][i] =
                  post[index(x, y, z)][static_cast<std::size_t>(lattice::d3q19::opposite[i])] +
                  6 * lattice::d3q19::w[i] * cu;
            } else {
              f[index(x, y, z)][i] = post[index(x - c[0], y - c[1], from)][i];
            }
          }
  }

  std::array<int, 3> size;
  bool plates = false;
  std::array<double, 3> lower{}, upper{};
  std::vector<Populations> f;  ///< f_i - w_i
  std::vector<std::array<double, 3>> force, u;

private:
  Populations collide(std::size_t n) {
    namespace q = lattice::d3q19;
    const auto& F = force[n];
    double rho = 1, j[3] = {0.5 * F[0], 0.5 * F[1], 0.5 * F[2]};
    for (std::size_t i = 0; i < 19; ++i) {
      rho += f[n][i];
      for (std::size_t d = 0; d < 3; ++d) j[d] += f[n][i] * q::e[i][d];
    }
    for (std::size_t d = 0; d < 3; ++d) u[n][d] = j[d] / rho;
    const auto equilibrium = [&](std::size_t i) {
      double cu = 0, uu = 0;
      for (std::size_t d = 0; d < 3; ++d) cu += q::e[i][d] * u[n][d], uu += u[n][d] * u[n][d];
      return q::w[i] * rho * (1 + 3 * cu + 4.5 * cu * cu - 1.5 * uu) - q::w[i];
    };
    const auto source = [&](std::size_t i) {
      double cu = 0, s = 0;
      for (std::size_t d = 0; d < 3; ++d) cu += q::e[i][d] * u[n][d];
      for (std::size_t d = 0; d < 3; ++d)
        s += (3 * (q::e[i][d] - u[n][d]) + 9 * cu * q::e[i][d]) * F[d];
      return q::w[i] * s;
    };
    Populations post;
    for (std::size_t i = 0; i < 19; ++i) {
      const auto k = static_cast<std::size_t>(q::opposite[i]);
      const double even = 0.5 * (f[n][i] + f[n][k]), odd = 0.5 * (f[n][i] - f[n][k]);
      const double even_eq = 0.5 * (equilibrium(i) + equilibrium(k)),
                   odd_eq = 0.5 * (equilibrium(i) - equilibrium(k));
      const double even_s = 0.5 * (source(i) + source(k)), odd_s = 0.5 * (source(i) - source(k));
      post[i] = f[n][i] + omega_plus_ * (even_eq - even) + omega_minus_ * (odd_eq - odd) +
                (1 - 0.5 * omega_plus_) * even_s + (1 - 0.5 * omega_minus_) * odd_s;
    }
    return post;
  }

  double omega_plus_, omega_minus_;
};

}  // namespace hemomag::test
