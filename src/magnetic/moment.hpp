#pragma once
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

}  // namespace hemomag::magnetic
