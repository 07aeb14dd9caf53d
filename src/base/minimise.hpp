#pragma once
#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

#include "base/vec3.hpp"

namespace hemomag {

struct MinimiseOptions {
  double largest_force = 1e-4;  ///< stop when no point feels more [force]
  double largest_move = 0.1;    ///< of a point in one step [length]
  double first_scale = 1e-3;    ///< step over force before any curvature is known [length/force]
  int most_evaluations = 100000;
};

struct Minimum {
  double energy = 0;
  double largest_force = 0;  ///< that is left
  int evaluations = 0;
};

namespace detail {
inline double inner(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}
inline double longest(const std::vector<Vec3>& a) {
  double most = 0;
  for (const Vec3& v : a) most = std::max(most, norm2(v));
  return std::sqrt(most);
}
inline void add(std::vector<Vec3>& a, double s, const std::vector<Vec3>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += s * b[i];
}

/// What L-BFGS remembers of the curvature (Nocedal & Wright 2006, algorithm 7.4).
class Curvature {
public:
  /// The direction of descent for the force `f`.
  std::vector<Vec3> direction(const std::vector<Vec3>& f, double first_scale) const {
    std::vector<Vec3> d = f;
    std::vector<double> alpha(pairs_.size());
    for (std::size_t k = pairs_.size(); k-- > 0;) {
      alpha[k] = inner(pairs_[k].step, d) / pairs_[k].product;
      add(d, -alpha[k], pairs_[k].change);
    }
    const double scale =
        pairs_.empty() ? first_scale
                       : pairs_.back().product / inner(pairs_.back().change, pairs_.back().change);
    for (Vec3& v : d) v *= scale;
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      add(d, alpha[k] - inner(pairs_[k].change, d) / pairs_[k].product, pairs_[k].step);
    return d;
  }

  /// @param change  of the gradient, over `step`; a pair without positive curvature is left out
  void remember(std::vector<Vec3> step, std::vector<Vec3> change) {
    const double product = inner(step, change);
    if (!(product > 1e-14 * std::sqrt(inner(step, step) * inner(change, change)))) return;
    constexpr std::size_t most = 24;
    if (pairs_.size() == most) pairs_.pop_front();
    pairs_.push_back({std::move(step), std::move(change), product});
  }
  void forget() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

private:
  struct Pair {
    std::vector<Vec3> step, change;
    double product;
  };
  std::deque<Pair> pairs_;
};
}  // namespace detail

/// Move the points to a local minimum of an energy by L-BFGS with a backtracking line search.
/// @param x       [n]  points, in: a start of finite energy, out: the minimum
/// @param energy  double energy(const std::vector<Vec3>& x, std::vector<Vec3>& force), with force
/// minus its gradient; may be infinite where x is out of bounds
/// Close to the minimum, where energies differ by rounding alone, a step counts when it lessens the
/// force along it.
template <class Energy>
Minimum minimise(std::vector<Vec3>& x, Energy energy, const MinimiseOptions& options = {}) {
  const std::size_t n = x.size();
  std::vector<Vec3> f(n), trial(n), f_trial(n);
  detail::Curvature curvature;
  Minimum m;
  m.energy = energy(x, f);
  m.evaluations = 1;
  for (;;) {
    m.largest_force = detail::longest(f);
    if (m.largest_force <= options.largest_force || m.evaluations >= options.most_evaluations)
      return m;
    const auto d = curvature.direction(f, options.first_scale);
    const double fall = detail::inner(f, d);
    bool moved = false;
    double step = std::min(1.0, options.largest_move / detail::longest(d));
    for (int halving = 0; fall > 0 && halving < 25 && !moved; ++halving, step *= 0.5) {
      for (std::size_t i = 0; i < n; ++i) trial[i] = x[i] + step * d[i];
      const double e = energy(trial, f_trial);
      ++m.evaluations;
      if (!std::isfinite(e)) continue;
      const bool falls = e <= m.energy - 1e-4 * step * fall;
      const bool rounding = std::fabs(e - m.energy) < 1e-11 * (1 + std::fabs(m.energy));
      if (!falls && !(rounding && std::fabs(detail::inner(f_trial, d)) < fall)) continue;
      std::vector<Vec3> moves(n), change(n);
      for (std::size_t i = 0; i < n; ++i) moves[i] = trial[i] - x[i], change[i] = f[i] - f_trial[i];
      curvature.remember(std::move(moves), std::move(change));
      x.swap(trial);
      f.swap(f_trial);
      m.energy = e;
      moved = true;
    }
    if (!moved && curvature.empty()) return m;
    if (!moved) curvature.forget();
  }
}

}  // namespace hemomag
