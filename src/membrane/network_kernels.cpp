// Compiled once per instruction set (hemo_simd): the element loops behind membrane/network.hpp.
// Each gathers the corners of a few elements, computes the law on all of them at once, and adds the
// forces one element after the other, so that the sum at a vertex has a fixed order.
#include "membrane/network_kernels.hpp"

#include "membrane/area_volume.hpp"
#include "membrane/bending.hpp"
#include "membrane/pack.hpp"
#include "membrane/springs.hpp"

namespace hemomag::membrane::HEMOMAG_SIMD {
namespace {

constexpr int width = Pack::width;

[[gnu::always_inline]] inline Pack3 gather(const double* x, const int* vertex) {
  Pack3 p;
#pragma GCC unroll 8
  for (int lane = 0; lane < width; ++lane) {
    const double* at = x + 3 * static_cast<std::ptrdiff_t>(vertex[lane]);
    p.x.v[lane] = at[0];
    p.y.v[lane] = at[1];
    p.z.v[lane] = at[2];
  }
  return p;
}

/// The forces of `corners` vertices of each lane's element, in memory.
template <int corners> struct Forces {
  alignas(64) double value[corners][3][width];

  [[gnu::always_inline]] inline void put(int corner, const Pack3& F) {
    *reinterpret_cast<Pack::Raw*>(value[corner][0]) = F.x.v;
    *reinterpret_cast<Pack::Raw*>(value[corner][1]) = F.y.v;
    *reinterpret_cast<Pack::Raw*>(value[corner][2]) = F.z.v;
  }
  [[gnu::always_inline]] inline void add_lane(int lane, double* f, const int* const* vertex,
                                              std::ptrdiff_t e) const {
#pragma GCC unroll 4
    for (int corner = 0; corner < corners; ++corner) {
      double* at = f + 3 * static_cast<std::ptrdiff_t>(vertex[corner][e + lane]);
      at[0] += value[corner][0][lane];
      at[1] += value[corner][1][lane];
      at[2] += value[corner][2][lane];
    }
  }
  /// Add to f the forces of elements e, e + 1, ... below `end`, one after the other.
  [[gnu::always_inline]] inline void add_to(double* f, const int* const* vertex, std::ptrdiff_t e,
                                            std::ptrdiff_t end) const {
    if (e + width <= end) {
#pragma GCC unroll 8
      for (int lane = 0; lane < width; ++lane) add_lane(lane, f, vertex, e);
    } else {
      for (int lane = 0; lane < end - e; ++lane) add_lane(lane, f, vertex, e);
    }
  }
};

[[gnu::always_inline]] inline double sum(Pack p, std::ptrdiff_t lanes) {
  double total = 0;
  for (int lane = 0; lane < width; ++lane)
    if (lane < lanes) total += p[lane];
  return total;
}

}  // namespace

std::ptrdiff_t edge_forces(const EdgeArgs& a) {
  const std::ptrdiff_t end = a.begin + a.count;
  std::ptrdiff_t overstretched = -1;
  for (std::ptrdiff_t e = a.begin; e < end; e += width) {
    const SpringOf<Pack> spring{Pack::load(a.l_max + e), Pack::load(a.wlc + e),
                                Pack::load(a.k_p + e), a.m};
    const Pack3 d = gather(a.x, a.vertex[0] + e) - gather(a.x, a.vertex[1] + e);
    const Pack l = norm(d);
    if (!all_less(l, spring.l_max) && overstretched < 0) {
      overstretched = e;
      while (l[static_cast<int>(overstretched - e)] <
             spring.l_max[static_cast<int>(overstretched - e)])
        ++overstretched;
    }
    const Pack3 F = (-tension(spring, l) / l) * d;
    Forces<2> forces;
    forces.put(0, F);
    forces.put(1, -F);
    forces.add_to(a.f, a.vertex, e, end);
  }
  return overstretched;
}

CellGeometry cell_geometry(const TriangleArgs& a) {
  const std::ptrdiff_t end = a.begin + a.count;
  Pack area(0.0), volume(0.0);
  CellGeometry rest{0, 0};
  for (std::ptrdiff_t e = a.begin; e < end; e += width) {
    const Pack3 p1 = gather(a.x, a.vertex[1] + e);
    const Pack3 n =
        twice_area_vector(gather(a.x, a.vertex[0] + e), p1, gather(a.x, a.vertex[2] + e));
    const Pack3 unwrap{Pack::load(a.unwrap[0] + e), Pack::load(a.unwrap[1] + e),
                       Pack::load(a.unwrap[2] + e)};
    // On a closed surface the sum of a point of each triangle times its area vector over three is
    // the volume.
    const Pack twice_area = norm(n), six_volumes = dot(p1 + unwrap, n);
    if (e + width <= end) {
      area += twice_area;
      volume += six_volumes;
    } else {
      rest = {sum(twice_area, end - e), sum(six_volumes, end - e)};
    }
  }
  return {(sum(area, width) + rest.area) / 2, (sum(volume, width) + rest.volume) / 6};
}

void triangle_forces(const TriangleArgs& a) {
  const std::ptrdiff_t end = a.begin + a.count;
  for (std::ptrdiff_t e = a.begin; e < end; e += width) {
    const Pack3 p[3] = {gather(a.x, a.vertex[0] + e), gather(a.x, a.vertex[1] + e),
                        gather(a.x, a.vertex[2] + e)};
    const Pack3 n = twice_area_vector(p[0], p[1], p[2]);
    const Pack length = norm(n);
    const Pack pull =
        restoring(Pack::load(a.k_d + e), 0.5 * length, Pack::load(a.area0 + e)) + a.area_pull;
    const auto A = area_forces(p[0], p[1], p[2], (1.0 / length) * n, pull);
    const auto V = volume_forces(n, Pack(a.volume_pull));
    Forces<3> forces;
    forces.put(0, A.a + V.a);
    forces.put(1, A.b + V.b);
    forces.put(2, A.c + V.c);
    forces.add_to(a.f, a.vertex, e, end);
  }
}

void hinge_forces(const HingeArgs& a) {
  const std::ptrdiff_t end = a.begin + a.count;
  for (std::ptrdiff_t e = a.begin; e < end; e += width) {
    const Pack3 p[4] = {gather(a.x, a.vertex[0] + e), gather(a.x, a.vertex[1] + e),
                        gather(a.x, a.vertex[2] + e), gather(a.x, a.vertex[3] + e)};
    const BendingOf<Pack> law{Pack::load(a.k_b + e), Pack::load(a.sine0 + e),
                              Pack::load(a.cosine0 + e)};
    const auto F = membrane::forces(law, make_hinge(p[0], p[1], p[2], p[3]), p[0], p[1], p[3]);
    Forces<4> forces;
    forces.put(0, F.f1);
    forces.put(1, F.f2);
    forces.put(2, F.f3);
    forces.put(3, F.f4);
    forces.add_to(a.f, a.vertex, e, end);
  }
}

}  // namespace hemomag::membrane::HEMOMAG_SIMD
