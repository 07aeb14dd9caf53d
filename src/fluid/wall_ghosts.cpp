#include "fluid/wall_ghosts.hpp"

#include <algorithm>

namespace hemomag::fluid {

template <class Real>
WallGhosts<Real>::WallGhosts(const lattice::NodeLayout& layout, const Real* distance) {
  constexpr int reach = 2;
  constexpr int farther = 4;      // squares of distances: the rest would add little and cost most
  constexpr double deepest = -4;  // no kernel of a point in the fluid reaches farther
  for (int z = 0; z < layout.size[2]; ++z)
    for (int y = 0; y < layout.size[1]; ++y)
      for (int x = 0; x < layout.size[0]; ++x) {
        const std::ptrdiff_t node = layout.index(x, y, z);
        const double d_s = static_cast<double>(distance[node]);
        if (d_s > 0 || d_s < deepest) continue;
        const auto for_each_fluid_node = [&](auto visit) {
          for (int k = -reach; k <= reach; ++k)
            for (int j = -reach; j <= reach; ++j)
              for (int i = -reach; i <= reach; ++i) {
                const std::ptrdiff_t at = node + layout.index(i, j, k);
                const double d = static_cast<double>(distance[at]);
                if (d > 0) visit(at, d, i * i + j * j + k * k);
              }
        };
        int nearest = 3 * reach * reach;
        for_each_fluid_node(
            [&](std::ptrdiff_t, double, int r2) { nearest = std::min(nearest, r2); });
        const std::size_t begin = terms_.size();
        double norm = 0, sum = 0;
        for_each_fluid_node([&](std::ptrdiff_t at, double d, int r2) {
          if (r2 > nearest + farther) return;
          const double weight = d / (r2 * r2);
          norm += weight * d;
          terms_.push_back({at, static_cast<Real>(weight)});
        });
        for (std::size_t t = begin; t < terms_.size(); ++t) {
          terms_[t].weight = static_cast<Real>(d_s * static_cast<double>(terms_[t].weight) / norm);
          sum += static_cast<double>(terms_[t].weight);
        }
        ghosts_.push_back({node, terms_.size(), static_cast<Real>(1 - sum)});
      }
}

template <class Real> void WallGhosts<Real>::fill_velocity(const NodeVector<Real>& u) const {
  std::size_t t = 0;
  for (const Ghost& ghost : ghosts_) {
    Real sum[3] = {};
    for (; t < ghost.end; ++t)
      for (std::size_t d = 0; d < 3; ++d) sum[d] += terms_[t].weight * u[d][terms_[t].node];
    for (std::size_t d = 0; d < 3; ++d) u[d][ghost.node] = sum[d];
  }
}

template <class Real> Vec3 WallGhosts<Real>::fold_force(const NodeVector<Real>& force) const {
  Vec3 share;
  std::size_t t = 0;
  for (const Ghost& ghost : ghosts_) {
    Real taken[3];
    for (std::size_t d = 0; d < 3; ++d) {
      taken[d] = force[d][ghost.node];
      share[d] += ghost.share * taken[d];
      force[d][ghost.node] = 0;
    }
    if (taken[0] == 0 && taken[1] == 0 && taken[2] == 0) {
      t = ghost.end;
      continue;
    }
    for (; t < ghost.end; ++t)
      for (std::size_t d = 0; d < 3; ++d) force[d][terms_[t].node] += terms_[t].weight * taken[d];
  }
  return share;
}

template class WallGhosts<double>;
template class WallGhosts<float>;

}  // namespace hemomag::fluid
