#pragma once
#include <cmath>

#include "magnetic/field_at.hpp"

namespace hemomag::magnetic {

/// Moment of a superparamagnetic sphere in the linear regime, m = chi V_c B/mu* (Eq. 22), mu* = 1.
inline Vec3 linear_moment(double chi_volume, const Vec3& B) { return chi_volume * B; }

/// (m . grad) B (Eqs. 23, 41).
inline Vec3 gradient_force(const Vec3& m, const FieldAt& at) {
  return m.x * at.gradient[0] + m.y * at.gradient[1] + m.z * at.gradient[2];
}

/// Energy of an induced linear moment, -m . B/2; minus its gradient is (m . grad) B where curl B =
/// 0.
inline double induced_energy(const Vec3& m, const Vec3& B) { return -0.5 * dot(m, B); }

/// 3 L(x)/x with Langevin's function L(x) = coth x - 1/x: 1 at 0, 3/x far out.
inline double langevin_factor(double x) {
  const double x2 = x * x;
  if (x < 0.2)  // the series, where the difference would lose digits
    return 1 -
           x2 * (1.0 / 15 - x2 * (2.0 / 315 - x2 * (1.0 / 1575 -
                                                    x2 * (2.0 / 31185 - x2 * 1382.0 / 212837625))));
  return 3 * (1 / std::tanh(x) - 1 / x) / x;
}

/// ln(sinh x/x), whose derivative is L(x).
inline double log_sinh_ratio(double x) {
  const double x2 = x * x;
  if (x < 0.2)
    return x2 * (1.0 / 6 - x2 * (1.0 / 180 - x2 * (1.0 / 2835 - x2 * (1.0 / 37800 - x2 / 467775))));
  return x + std::log1p(-std::exp(-2 * x)) - std::log(2 * x);
}

/// How a carrier is magnetised by a field: linearly (Eq. 22), or by Langevin's law
/// m = m_s L(3 chi V_c B/m_s), which begins with the same slope and saturates at m_s.
struct Magnetisation {
  double chi_volume = 0;  ///< chi V_c
  double saturation = 0;  ///< m_s, or 0: linear

  Vec3 moment(const Vec3& B) const {
    if (saturation == 0) return linear_moment(chi_volume, B);
    return langevin_factor(3 * chi_volume * norm(B) / saturation) * linear_moment(chi_volume, B);
  }

  /// - int m dB; minus its gradient is (m . grad) B where curl B = 0.
  double energy(const Vec3& B) const {
    if (saturation == 0) return induced_energy(linear_moment(chi_volume, B), B);
    if (chi_volume == 0) return 0;
    return -saturation * saturation / (3 * chi_volume) *
           log_sinh_ratio(3 * chi_volume * norm(B) / saturation);
  }
};

}  // namespace hemomag::magnetic
