#include "magnetic/round_sources.hpp"

#include <algorithm>
#include <numbers>

#include "magnetic/elliptic.hpp"

namespace hemomag::magnetic {
namespace {

/// A field of revolution at (rho, z). div B = 0 and curl B = 0 give its other derivatives.
struct Meridian {
  double Bz = 0;
  double Brho_over_rho = 0;  ///< regular on the axis
  double dBz_dz = 0;
  double dBrho_dz = 0;

  Meridian& operator+=(const Meridian& b) {
    Bz += b.Bz, Brho_over_rho += b.Brho_over_rho, dBz_dz += b.dBz_dz, dBrho_dz += b.dBrho_dz;
    return *this;
  }
  friend Meridian operator*(double s, const Meridian& m) {
    return {s * m.Bz, s * m.Brho_over_rho, s * m.dBz_dz, s * m.dBrho_dz};
  }
};

FieldAt in_space(const Frame& frame, const Vec3& p, const Meridian& m) {
  const double rho = std::hypot(p.x, p.y);
  const double c = rho > 0 ? p.x / rho : 1, s = rho > 0 ? p.y / rho : 0;
  const double around = m.Brho_over_rho, outward = -m.dBz_dz - around;
  FieldAt at;
  at.B = {p.x * around, p.y * around, m.Bz};
  const double xy = (outward - around) * c * s;
  at.gradient[0] = {outward * c * c + around * s * s, xy, m.dBrho_dz * c};
  at.gradient[1] = {xy, outward * s * s + around * c * c, m.dBrho_dz * s};
  at.gradient[2] = {m.dBrho_dz * c, m.dBrho_dz * s, m.dBz_dz};
  return frame.world(at);
}

/// Loop of radius a with I a/4 pi = 1, at the height zeta above it. All from the integrals
///   int cos^2/Delta^3 = D,   int sin^2/Delta^3 = B/kc^2,   int sin^2 cos^2/Delta^5 = (D - C)/3
///   kc^2,
/// in whose combinations nothing cancels near the axis.
Meridian loop(double a, double rho, double zeta, const RingIntegrals& ring) {
  const double s3 = ring.s * ring.s * ring.s, s5 = s3 * ring.s * ring.s;
  const double sin3 = ring.B / ring.kc2;
  const double cross5 = (ring.D - ring.C) / (3 * ring.kc2);
  const double cos5 = ring.D - ring.kc2 * cross5 + cross5;
  const double sin5 = cross5 + (sin3 - cross5) / ring.kc2;
  Meridian m;
  m.Bz = 4 / s3 * ((a + rho) * ring.D + (a - rho) * sin3);
  m.Brho_over_rho = 48 * a * zeta / s5 * cross5;
  m.dBz_dz = -12 * zeta / s5 * ((a + rho) * cos5 + (a - rho) * sin5);
  m.dBrho_dz = 48 * a * rho / s5 * cross5 - 12 * zeta * zeta / s5 * (sin5 - cos5);
  return m;
}

/// A stack of loops that reaches from far below up to the height zeta under the place, less what
/// does not depend on zeta.
Meridian stack(double a, double rho, double zeta) {
  const RingIntegrals ring(a, rho, zeta);
  const double kc = std::sqrt(ring.kc2), gamma = (a - rho) / (a + rho);
  // Above the rim (rho = a) the jump of the integral cancels between the two ends: its mean.
  const double third = gamma == 0 ? cel(kc, 1, 1, 1) : cel(kc, gamma * gamma, 1, gamma);
  const Meridian end = loop(a, rho, zeta, ring);
  Meridian m;
  m.Bz = 4 * zeta / (ring.s * (a + rho)) * third;
  m.Brho_over_rho = -16 * a / (ring.s * ring.s * ring.s) * ring.C;
  m.dBz_dz = end.Bz;
  m.dBrho_dz = rho * end.Brho_over_rho;
  return m;
}

}  // namespace

FieldAt CurrentLoop::operator()(const Vec3& x) const {
  const Vec3 p = frame.local(x);
  const double rho = std::hypot(p.x, p.y);
  const RingIntegrals ring(radius, rho, p.z);
  return in_space(frame, p,
                  current * radius / (4 * std::numbers::pi) * loop(radius, rho, p.z, ring));
}

Vec3 CurrentLoop::nearest(const Vec3& x) const {
  const Vec3 p = frame.local(x);
  const double rho = std::hypot(p.x, p.y);
  return frame.place(rho > 0 ? Vec3{p.x * radius / rho, p.y * radius / rho, 0}
                             : Vec3{radius, 0, 0});
}

FieldAt CylinderMagnet::operator()(const Vec3& x) const {
  const Vec3 p = frame.local(x);
  const double rho = std::hypot(p.x, p.y);
  Meridian m = stack(radius, rho, p.z + half);
  m += -1.0 * stack(radius, rho, p.z - half);
  return in_space(frame, p, remanence * radius / (4 * std::numbers::pi) * m);
}

Vec3 CylinderMagnet::nearest(const Vec3& x) const {
  Vec3 p = frame.local(x);
  const double shrink = std::min(1.0, radius / std::max(std::hypot(p.x, p.y), 1e-300));
  return frame.place({p.x * shrink, p.y * shrink, std::clamp(p.z, -half, half)});
}

FieldAt StraightWire::operator()(const Vec3& x) const {
  const Vec3 p = frame.local(x);
  const double d2 = p.x * p.x + p.y * p.y, c = current / (2 * std::numbers::pi * d2);
  FieldAt at;
  at.B = {-c * p.y, c * p.x, 0};
  const double shear = 2 * c * p.x * p.y / d2, stretch = c * (p.y * p.y - p.x * p.x) / d2;
  at.gradient[0] = {shear, stretch, 0};
  at.gradient[1] = {stretch, -shear, 0};
  return frame.world(at);
}

Vec3 StraightWire::nearest(const Vec3& x) const { return frame.place({0, 0, frame.local(x).z}); }

}  // namespace hemomag::magnetic
