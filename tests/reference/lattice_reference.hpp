#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "lattice/d3q19.hpp"

namespace hemomag::test {

/// The scalar oracle: D3Q19 with TRT and Guo forcing, or with the exponential scheme, on a periodic
/// box, optionally closed by plates along z or with solid nodes, written from the equations with
/// whole copies of the populations. Slow and plain on purpose.
class ReferenceFluid {
public:
  using Populations = std::array<double, 19>;
  ReferenceFluid(std::array<int, 3> n, double tau, double magic)
      : size(n), f(nodes()), force(nodes()), u(nodes()), tau_(tau), magic_(magic) {}

  std::size_t nodes() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  std::size_t index(int x, int y, int z) const {
    const auto wrap = [](int i, int n) { return (i % n + n) % n; };
    return static_cast<std::size_t>((wrap(z, size[2]) * size[1] + wrap(y, size[1])) * size[0] +
                                    wrap(x, size[0]));
  }

  /// Take the exponential scheme; f must hold the initial populations, u their velocity.
  void start_exponential() {
    exponential_ = true;
    for (std::size_t n = 0; n < nodes(); ++n) {
      const auto F = force[n];
      force[n] = {};
      g_last_.push_back(source(n, 1.0));
      force[n] = F;
    }
  }

  void step() {
    std::vector<Populations> next(nodes());
    if (exponential_)
      exponential_step(next);
    else
      two_rate_step(next);
    f = next;
  }

  std::array<int, 3> size;
  bool plates = false;
  std::array<double, 3> lower{}, upper{};
  /// Part of the link from a fluid node along a direction that lies in the fluid; for solid nodes
  /// at its end. With `solid` empty all nodes are fluid.
  std::vector<char> solid;
  std::function<double(int, int, int, std::size_t)> fraction;
  std::vector<Populations> f;  ///< f_i - w_i
  std::vector<std::array<double, 3>> force, u;

private:
  static constexpr auto& e = lattice::d3q19::e;
  static std::size_t opposite(std::size_t i) {
    return static_cast<std::size_t>(lattice::d3q19::opposite[i]);
  }
  bool wet(std::size_t n) const { return solid.empty() || !solid[n]; }

  template <class Visit> void for_each_population(Visit visit) const {
    for (int z = 0; z < size[2]; ++z)
      for (int y = 0; y < size[1]; ++y)
        for (int x = 0; x < size[0]; ++x)
          if (wet(index(x, y, z)))
            for (std::size_t i = 0; i < 19; ++i) visit(x, y, z, i);
  }

  /// 6 w_i e_i . u_w of the plate at whose far side z lies.
  double push(std::size_t i, int z) const {
    const auto& wall = z < 0 ? lower : upper;
    return 6 * lattice::d3q19::w[i] * (e[i][0] * wall[0] + e[i][1] * wall[1] + e[i][2] * wall[2]);
  }
  bool beyond(int z) const { return plates && (z < 0 || z >= size[2]); }

  void two_rate_step(std::vector<Populations>& next) {
    std::vector<Populations> post(nodes());
    for (std::size_t n = 0; n < nodes(); ++n)
      if (wet(n)) post[n] = collide(n);
    for_each_population([&](int x, int y, int z, std::size_t i) {
      const std::size_t here = index(x, y, z), k = opposite(i);
      const int from = z - e[i][2];
      double& value = next[here][i];
      if (beyond(from)) {
        value = post[here][k] + push(i, from);
      } else if (!wet(index(x - e[i][0], y - e[i][1], from))) {
        const double q = fraction(x, y, z, k);
        const std::size_t behind = index(x + e[i][0], y + e[i][1], z + e[i][2]);
        if (q >= 0.5)
          value = post[here][k] / (2 * q) + (1 - 1 / (2 * q)) * post[here][i];
        else if (wet(behind))
          value = 2 * q * post[here][k] + (1 - 2 * q) * post[behind][k];
        else
          value = post[here][k];
      } else {
        value = post[index(x - e[i][0], y - e[i][1], from)][i];
      }
    });
  }

  /// The scheme as it is written, with g beyond walls reflected half-way.
  void exponential_step(std::vector<Populations>& next) {
    const double E = std::exp(-1 / tau_), D = 1 - (1 - E) * tau_, K = 0.5 - D * (tau_ + 0.5);
    std::vector<Populations> g(nodes());
    for (std::size_t n = 0; n < nodes(); ++n) {
      if (!wet(n)) continue;
      double rho = 1, j[3] = {0, 0, 0};
      for (std::size_t i = 0; i < 19; ++i) {
        rho += f[n][i];
        for (std::size_t d = 0; d < 3; ++d) j[d] += f[n][i] * e[i][d];
      }
      for (std::size_t d = 0; d < 3; ++d) u[n][d] = j[d] / rho;
      g[n] = source(n, rho);
    }
    for_each_population([&](int x, int y, int z, std::size_t i) {
      const std::size_t here = index(x, y, z), k = opposite(i);
      const auto at = [&](const std::vector<Populations>& field, int sense) {
        const int to = z + sense * e[i][2];
        const std::size_t there = index(x + sense * e[i][0], y + sense * e[i][1], to);
        // Beyond a wall: the population of the opposite sense, and what a moving wall adds.
        if (beyond(to)) return field[here][k] + push(i, to);
        return wet(there) ? field[there][i] : field[here][k];
      };
      const double f_behind = at(f, -1), g_behind = at(g, -1), last_behind = at(g_last_, -1);
      next[here][i] = g_behind + E * (f_behind - g_behind) + D * (g[here][i] - last_behind) +
                      K * (at(g, 1) - g_last_[here][i] - g[here][i] + last_behind);
    });
    g_last_ = g;
  }

  /// f_eq + tau F_i less the weights.
  Populations source(std::size_t n, double rho) const {
    Populations g;
    for (std::size_t i = 0; i < 19; ++i) g[i] = equilibrium(n, i, rho) + tau_ * guo(n, i);
    return g;
  }

  double equilibrium(std::size_t n, std::size_t i, double rho) const {
    double cu = 0, uu = 0;
    for (std::size_t d = 0; d < 3; ++d) cu += e[i][d] * u[n][d], uu += u[n][d] * u[n][d];
    const double w = lattice::d3q19::w[i];
    return w * rho * (1 + 3 * cu + 4.5 * cu * cu - 1.5 * uu) - w;
  }

  double guo(std::size_t n, std::size_t i) const {
    double cu = 0, s = 0;
    for (std::size_t d = 0; d < 3; ++d) cu += e[i][d] * u[n][d];
    for (std::size_t d = 0; d < 3; ++d)
      s += (3 * (e[i][d] - u[n][d]) + 9 * cu * e[i][d]) * force[n][d];
    return lattice::d3q19::w[i] * s;
  }

  Populations collide(std::size_t n) {
    const double omega_plus = 1 / tau_, omega_minus = 1 / (0.5 + magic_ / (tau_ - 0.5));
    const auto& F = force[n];
    double rho = 1, j[3] = {0.5 * F[0], 0.5 * F[1], 0.5 * F[2]};
    for (std::size_t i = 0; i < 19; ++i) {
      rho += f[n][i];
      for (std::size_t d = 0; d < 3; ++d) j[d] += f[n][i] * e[i][d];
    }
    for (std::size_t d = 0; d < 3; ++d) u[n][d] = j[d] / rho;
    Populations post;
    for (std::size_t i = 0; i < 19; ++i) {
      const std::size_t k = opposite(i);
      const double eq_i = equilibrium(n, i, rho), eq_k = equilibrium(n, k, rho);
      const double s_i = guo(n, i), s_k = guo(n, k);
      const double even = 0.5 * (f[n][i] + f[n][k]), odd = 0.5 * (f[n][i] - f[n][k]);
      post[i] = f[n][i] + omega_plus * (0.5 * (eq_i + eq_k) - even) +
                omega_minus * (0.5 * (eq_i - eq_k) - odd) +
                (1 - 0.5 * omega_plus) * 0.5 * (s_i + s_k) +
                (1 - 0.5 * omega_minus) * 0.5 * (s_i - s_k);
    }
    return post;
  }

  double tau_, magic_;
  bool exponential_ = false;
  std::vector<Populations> g_last_;
};

}  // namespace hemomag::test
