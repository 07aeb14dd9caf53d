#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/vec3.hpp"
#include "fluid/plates.hpp"
#include "fluid/sweep.hpp"
#include "lattice/node_layout.hpp"

// Walls at rest of any shape: the links from a fluid node to a solid one, along each of which what
// leaves the fluid comes back (Bouzidi, Firdaouss & Lallemand, Phys. Fluids 13:3452, 2001). With q
// the part of the link that lies in the fluid, i the direction into the wall and j the opposite,
//
//   q < 1/2    f_j(x, t+1) = 2q f_i*(x) + (1 - 2q) f_i*(x - e_i)
//   q >= 1/2   f_j(x, t+1) = f_i*(x)/(2q) + (1 - 1/(2q)) f_j*(x)
//
// and q = 1/2 is half-way bounce-back. Solid nodes take part in the sweep, at rest; the value that
// returns is put where the sweep looks for it:
//                  f_i*(x)             f_i*(x - e_i)      f_j*(x)            returning
//   before shift   slot j of x         slot j of x - e_i  slot i of x        slot i of x + e_i
//   after shift    slot i of x + e_i   slot i of x        slot j of x - e_i  slot j of x
// No place is read by one link and written by another.

namespace hemomag::fluid {

enum class WallRule {
  interpolated,  ///< the wall where it is
  halfway,       ///< the wall in the middle of every link
};

template <class Real> class WallLinks {
public:
  WallLinks() = default;

  /// @param wet       (x, y, z) of the block or one node beyond: is it a fluid node?
  /// @param fraction  (x, y, z, direction): part of the link that lies in the fluid, in (0, 1]
  WallLinks(const lattice::NodeLayout& layout, WallRule rule,
            const std::function<bool(int, int, int)>& wet,
            const std::function<double(int, int, int, int)>& fraction);

  /// The wall's work before or after a shift pass.
  /// @param streamed  see fluid/plates.hpp
  /// @return momentum given to the wall
  Vec3 bounce_before_shift(const Populations<Real>& f, double streamed) const {
    return bounce(f, true, streamed);
  }
  Vec3 bounce_after_shift(const Populations<Real>& f, double streamed) const {
    return bounce(f, false, streamed);
  }

  /// Visit every link: visit(direction into the wall, offset of its fluid node).
  template <class Visit> void for_each(Visit visit) const {
    for (std::size_t i = 1; i < 19; ++i)
      for (const auto* links : {&near_[i], &far_[i]})
        for (const Link& link : *links) visit(static_cast<int>(i), link.x);
  }

  std::size_t size() const;

private:
  struct Link {
    std::ptrdiff_t x;    ///< offset of the fluid node
    Real direct, other;  ///< weights of f_i*(x) and of the second population
  };
  Vec3 bounce(const Populations<Real>& f, bool before, double streamed) const;

  lattice::NodeLayout layout_;
  std::array<std::vector<Link>, 19> near_, far_;  ///< q < 1/2 and q >= 1/2, by direction
};

}  // namespace hemomag::fluid
