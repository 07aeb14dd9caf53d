#pragma once
#include "fluid/equilibrium.hpp"
#include "solver/fluid_solver.hpp"

namespace hemomag::solver {

/// @param field  (position of the node) -> std::pair<Vec3, fluid::VelocityGradient>
template <class Field> void FluidSolver::initialise(Field field) {
  for (int z = 0; z < block().size[2]; ++z)
    for (int y = 0; y < block().size[1]; ++y)
      for (int x = 0; x < block().size[0]; ++x) {
        const Vec3 position{block().begin[0] + x + 0.5, block().begin[1] + y + 0.5,
                            block().begin[2] + z + 0.5};
        const auto [u, grad_u] = field(position);
        set_node(x, y, z, fluid::populations(1.0, u, grad_u, parameters_.relaxation.tau));
        for (int d = 0; d < 3; ++d)
          u_[static_cast<std::size_t>(d)][n_layout_.index(x, y, z)] =
              u[static_cast<std::size_t>(d)];
      }
  finish_initialise();
}

}  // namespace hemomag::solver
