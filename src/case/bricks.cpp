#include "case/bricks.hpp"

#include <string>

#include "base/error.hpp"
#include "case/lattice_units.hpp"
#include "case/script.hpp"
#include "lammps/host.hpp"
#include "solver/fluid_solver.hpp"

namespace hemomag::case_ {

RankGrid rank_grid(const Case& c, MPI_Comm comm) {
  const auto n = nodes(c);
  lammps::Host host({"-screen", "none", "-log", "none"}, comm);
  host.command("units lj");
  host.command("region box block 0 " + std::to_string(n[0]) + " 0 " + std::to_string(n[1]) + " 0 " +
               std::to_string(n[2]));
  host.command("create_box 1 box");
  return host.rank_grid();
}

void require_bricks(const Case& c, const RankGrid& ranks) {
  const auto n = nodes(c);
  const int needed = solver::coupling_halo(0.5 * skin);
  for (std::size_t d = 0; d < 3; ++d) {
    const int brick = n[d] / ranks[d];
    if (brick < needed)
      throw Error(position(c, "channel.size") + ": leaves a rank a brick of " +
                  std::to_string(brick) + " nodes along " + "xyz"[d] + " (" +
                  std::to_string(ranks[0]) + " x " + std::to_string(ranks[1]) + " x " +
                  std::to_string(ranks[2]) + " ranks); accepted: at least " +
                  std::to_string(needed) + ", by fewer ranks, a larger channel or a finer dx");
  }
}

}  // namespace hemomag::case_
