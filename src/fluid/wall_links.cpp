#include "fluid/wall_links.hpp"

#include "lattice/d3q19.hpp"

namespace hemomag::fluid {

using namespace lattice::d3q19;

template <class Real>
WallLinks<Real>::WallLinks(const lattice::NodeLayout& layout, WallRule rule,
                           const std::function<bool(int, int, int)>& wet,
                           const std::function<double(int, int, int, int)>& fraction)
    : layout_(layout) {
  for (int z = 0; z < layout.size[2]; ++z)
    for (int y = 0; y < layout.size[1]; ++y)
      for (int x = 0; x < layout.size[0]; ++x) {
        if (!wet(x, y, z)) continue;
        for (std::size_t i = 1; i < Q; ++i) {
          const auto& c = e[i];
          if (wet(x + c[0], y + c[1], z + c[2])) continue;
          const std::ptrdiff_t at = layout.index(x, y, z);
          const double q = rule == WallRule::halfway ? 0.5 : fraction(x, y, z, static_cast<int>(i));
          if (q >= 0.5)
            far_[i].push_back({at, static_cast<Real>(0.5 / q), static_cast<Real>(1 - 0.5 / q)});
          else if (wet(x - c[0], y - c[1], z - c[2]))
            near_[i].push_back({at, static_cast<Real>(2 * q), static_cast<Real>(1 - 2 * q)});
          else  // too narrow a gap to interpolate in
            far_[i].push_back({at, Real(1), Real(0)});
        }
      }
}

template <class Real>
Vec3 WallLinks<Real>::bounce(const Populations<Real>& f, bool before, double streamed) const {
  Vec3 given;
  for (std::size_t i = 1; i < Q; ++i) {
    const auto j = static_cast<std::size_t>(opposite[i]);
    const auto& c = e[i];
    const std::ptrdiff_t o = layout_.index(c[0], c[1], c[2]);
    Real* const inside = f[j];       // slot j of x
    Real* const outside = f[i] + o;  // slot i of x + e_i
    const Real* const leaving = before ? inside : outside;
    Real* const returning = before ? outside : inside;
    const Real* const behind = before ? f[j] - o : f[i];  // f_i*(x - e_i)
    const Real* const back = before ? f[i] : f[j] - o;    // f_j*(x)
    double sum = 0;
    const auto turn = [&](const std::vector<Link>& links, const Real* other) {
      for (const Link& link : links) {
        const Real out = leaving[link.x];
        const Real in = link.direct * out + link.other * other[link.x];
        returning[link.x] = in;
        sum += out + in;
      }
      sum += 2 * streamed * w[i] * static_cast<double>(links.size());
    };
    turn(near_[i], behind);
    turn(far_[i], back);
    given +=
        sum * Vec3{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
  }
  return given;
}

template <class Real> std::size_t WallLinks<Real>::size() const {
  std::size_t n = 0;
  for (std::size_t i = 0; i < 19; ++i) n += near_[i].size() + far_[i].size();
  return n;
}

template class WallLinks<double>;
template class WallLinks<float>;

}  // namespace hemomag::fluid
