#include "fluid/plates.hpp"

#include "lattice/d3q19.hpp"

namespace hemomag::fluid {
namespace {

using namespace lattice::d3q19;

Vec3 direction(int i) {
  return {static_cast<double>(e[i][0]), static_cast<double>(e[i][1]), static_cast<double>(e[i][2])};
}

/// The layer of nodes that touch the plate.
lattice::NodeBox first_layer(const Plate& plate, const lattice::NodeLayout& layout) {
  lattice::NodeBox box{{0, 0, 0}, layout.size};
  const int at = plate.side == Side::low ? 0 : layout.size[plate.axis] - 1;
  box.lo[plate.axis] = at;
  box.hi[plate.axis] = at + 1;
  return box;
}

enum class Moment { before_shift, after_shift };

// The population that leaves the fluid along j and the one that returns along opposite(j) sit at
//              leaving             returning
//   before     slot opp(j) of x    slot j of x + e_j... seen from opp(j): slot opp(opp(j)) of x -
//   e_opp(j) after      slot j of x + e_j   slot opp(j) of x
// so both moments copy between the same two places, in opposite senses.
template <Moment moment>
Vec3 bounce(const Plate& plate, const Populations& f, const lattice::NodeLayout& layout) {
  Vec3 given;
  for (const int j : crossing(plate.axis, plate.side == Side::low ? -1 : 1)) {
    const int back = opposite[j];
    const double push = 6.0 * w[j] * dot(direction(back), plate.velocity);
    const std::ptrdiff_t beyond = layout.index(e[j][0], e[j][1], e[j][2]);
    double sum = 0;
    for_each_row(first_layer(plate, layout), layout, [&](std::ptrdiff_t row, int n) {
      double* inside = f[back] + row;
      double* outside = f[j] + row + beyond;
      const double* leaving = moment == Moment::before_shift ? inside : outside;
      double* returning = moment == Moment::before_shift ? outside : inside;
      for (int x = 0; x < n; ++x) {
        const double out = leaving[x];
        returning[x] = out + push;
        sum += 2.0 * (out + w[j]) + push;
      }
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

Vec3 bounce_before_shift(const Plate& plate, const Populations& f,
                         const lattice::NodeLayout& layout) {
  return bounce<Moment::before_shift>(plate, f, layout);
}

Vec3 bounce_after_shift(const Plate& plate, const Populations& f,
                        const lattice::NodeLayout& layout) {
  return bounce<Moment::after_shift>(plate, f, layout);
}

void fill_mirror_velocity(const Plate& plate, const NodeVector& u,
                          const lattice::NodeLayout& layout, const lattice::NodeBox& box) {
  for (int d = 0; d < 3; ++d) {
    const double twice = 2.0 * plate.velocity[static_cast<std::size_t>(d)];
    for_each_mirror_row(plate, layout, box,
                        [&](std::ptrdiff_t ghost, std::ptrdiff_t mirror, int n) {
                          for (int x = 0; x < n; ++x) u[d][ghost + x] = twice - u[d][mirror + x];
                        });
  }
}

Vec3 fold_mirror_force(const Plate& plate, const NodeVector& force,
                       const lattice::NodeLayout& layout, const lattice::NodeBox& box) {
  Vec3 share;
  for (int d = 0; d < 3; ++d) {
    double sum = 0;
    for_each_mirror_row(plate, layout, box,
                        [&](std::ptrdiff_t ghost, std::ptrdiff_t mirror, int n) {
                          for (int x = 0; x < n; ++x) {
                            sum += force[d][ghost + x];
                            force[d][mirror + x] -= force[d][ghost + x];
                            force[d][ghost + x] = 0;
                          }
                        });
    share[static_cast<std::size_t>(d)] = 2 * sum;
  }
  return share;
}

}  // namespace hemomag::fluid
