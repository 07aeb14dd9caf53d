#include "fluid/plates.hpp"

#include "lattice/d3q19.hpp"

namespace hemomag::fluid {
namespace {

using namespace lattice::d3q19;

Vec3 direction(int i) {
  return {static_cast<double>(e[i][0]), static_cast<double>(e[i][1]), static_cast<double>(e[i][2])};
}

enum class Moment { before_shift, after_shift };

// The population that leaves the fluid along j and the one that returns along opposite(j) sit at
//              leaving              returning
//   before     slot opp(j) of x     slot j of x + e_j
//   after      slot j of x + e_j    slot opp(j) of x
// so both moments copy between the same two places, in opposite senses.
template <Moment moment, class Real>
Vec3 bounce(const Plate& plate, const Populations<Real>& f, const lattice::NodeLayout& layout,
            double streamed) {
  Vec3 given;
  for (const int j : crossing(plate.axis, plate.side == Side::low ? -1 : 1)) {
    const int back = opposite[j];
    const Real push =
        static_cast<Real>(6.0 * streamed * w[j] * dot(direction(back), plate.velocity));
    const std::ptrdiff_t beyond = layout.index(e[j][0], e[j][1], e[j][2]);
    double sum = 0;
    for_each_row(first_layer(plate, layout), layout, [&](std::ptrdiff_t row, int n) {
      Real* inside = f[back] + row;
      Real* outside = f[j] + row + beyond;
      const Real* leaving = moment == Moment::before_shift ? inside : outside;
      Real* returning = moment == Moment::before_shift ? outside : inside;
      Real given_by_row = 0;
      for (int x = 0; x < n; ++x) {
        const Real out = leaving[x];
        returning[x] = out + push;
        given_by_row += out;
      }
      sum += 2.0 * (given_by_row + n * streamed * w[j]) + static_cast<Real>(n) * push;
    });
    given += sum * direction(j);
  }
  return given;
}

/// Visit pairs of rows (ghost, mirror) of the two ghost layers that a four-point kernel can reach.
template <class Visit>
void for_each_mirror_row(const Plate& plate, const lattice::NodeLayout& layout,
                         lattice::NodeBox box, Visit visit) {
  const int last = layout.size[plate.axis] - 1;
  for (int depth = 0; depth < layout.halo && depth <= last; ++depth) {
    const int ghost = plate.side == Side::low ? -1 - depth : last + 1 + depth;
    const int mirror = plate.side == Side::low ? depth : last - depth;
    box.lo[plate.axis] = ghost;
    box.hi[plate.axis] = ghost + 1;
    std::array<int, 3> step{};
    step[plate.axis] = mirror - ghost;
    const std::ptrdiff_t to_mirror = layout.index(step[0], step[1], step[2]);
    for_each_row(box, layout, [&](std::ptrdiff_t row, int n) { visit(row, row + to_mirror, n); });
  }
}

}  // namespace

lattice::NodeBox first_layer(const Plate& plate, const lattice::NodeLayout& layout) {
  lattice::NodeBox box{{0, 0, 0}, layout.size};
  const int at = plate.side == Side::low ? 0 : layout.size[plate.axis] - 1;
  box.lo[plate.axis] = at;
  box.hi[plate.axis] = at + 1;
  return box;
}

template <class Real>
Vec3 bounce_before_shift(const Plate& plate, const Populations<Real>& f,
                         const lattice::NodeLayout& layout, double streamed) {
  return bounce<Moment::before_shift>(plate, f, layout, streamed);
}

template <class Real>
Vec3 bounce_after_shift(const Plate& plate, const Populations<Real>& f,
                        const lattice::NodeLayout& layout, double streamed) {
  return bounce<Moment::after_shift>(plate, f, layout, streamed);
}

template <class Real>
void fill_mirror_velocity(const Plate& plate, const NodeVector<Real>& u,
                          const lattice::NodeLayout& layout, const lattice::NodeBox& box) {
  for (std::size_t d = 0; d < 3; ++d) {
    const Real twice = static_cast<Real>(2.0 * plate.velocity[d]);
    for_each_mirror_row(plate, layout, box,
                        [&](std::ptrdiff_t ghost, std::ptrdiff_t mirror, int n) {
                          for (int x = 0; x < n; ++x) u[d][ghost + x] = twice - u[d][mirror + x];
                        });
  }
}

template <class Real>
Vec3 fold_mirror_force(const Plate& plate, const NodeVector<Real>& force,
                       const lattice::NodeLayout& layout, const lattice::NodeBox& box) {
  Vec3 share;
  for (std::size_t d = 0; d < 3; ++d) {
    double sum = 0;
    for_each_mirror_row(plate, layout, box,
                        [&](std::ptrdiff_t ghost, std::ptrdiff_t mirror, int n) {
                          for (int x = 0; x < n; ++x) {
                            sum += force[d][ghost + x];
                            force[d][mirror + x] -= force[d][ghost + x];
                            force[d][ghost + x] = 0;
                          }
                        });
    share[d] = 2 * sum;
  }
  return share;
}

#define HEMOMAG_INSTANTIATE(Real)                                                                  \
  template Vec3 bounce_before_shift(const Plate&, const Populations<Real>&,                        \
                                    const lattice::NodeLayout&, double);                           \
  template Vec3 bounce_after_shift(const Plate&, const Populations<Real>&,                         \
                                   const lattice::NodeLayout&, double);                            \
  template void fill_mirror_velocity(const Plate&, const NodeVector<Real>&,                        \
                                     const lattice::NodeLayout&, const lattice::NodeBox&);         \
  template Vec3 fold_mirror_force(const Plate&, const NodeVector<Real>&,                           \
                                  const lattice::NodeLayout&, const lattice::NodeBox&);
HEMOMAG_INSTANTIATE(double)
HEMOMAG_INSTANTIATE(float)
#undef HEMOMAG_INSTANTIATE

}  // namespace hemomag::fluid
