#include "lammps/orient_triangles.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "lammps.h"

#include "solver/rendezvous.hpp"

namespace hemomag::lammps {
namespace {

using LAMMPS_NS::tagint;
using Triple = std::array<tagint, 3>;

/// The same orientation with the smallest tag first.
Triple canonical(Triple t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

}  // namespace

LAMMPS_NS::bigint orient_triangles(LAMMPS_NS::LAMMPS& lmp) {
  auto& atom = *lmp.atom;
  const auto ranks = static_cast<std::size_t>(lmp.comm->nprocs);
  const auto keeper = [&](const Triple& t) { return static_cast<std::size_t>(t[0]) % ranks; };

  std::vector<std::vector<Triple>> outward(ranks), ask(ranks);
  struct Place {
    int atom, angle;
  };
  std::vector<std::vector<Place>> asked_for(ranks);
  for (int i = 0; i < atom.nlocal; ++i) {
    for (int n = 0; n < atom.num_dihedral[i]; ++n) {
      const tagint t1 = atom.dihedral_atom1[i][n], t2 = atom.dihedral_atom2[i][n],
                   t3 = atom.dihedral_atom3[i][n], t4 = atom.dihedral_atom4[i][n];
      for (const Triple& t : {canonical({t1, t2, t3}), canonical({t4, t3, t2})}) outward[keeper(t)].push_back(t);
    }
    for (int n = 0; n < atom.num_angle[i]; ++n) {
      const Triple t = canonical({atom.angle_atom1[i][n], atom.angle_atom2[i][n], atom.angle_atom3[i][n]});
      ask[keeper(t)].push_back(t);
      asked_for[keeper(t)].push_back({i, n});
    }
  }
  std::set<Triple> known;
  for (const auto& part : solver::exchange_by_rank(lmp.world, outward)) known.insert(part.begin(), part.end());
  std::vector<std::vector<char>> answer(ranks);
  const auto questions = solver::exchange_by_rank(lmp.world, ask);
  for (std::size_t r = 0; r < ranks; ++r)
    for (const Triple& t : questions[r])
      answer[r].push_back(!known.contains(t) && known.contains({t[0], t[2], t[1]}));

  const auto turn = solver::exchange_by_rank(lmp.world, answer);
  LAMMPS_NS::bigint mine = 0, all = 0;
  for (std::size_t r = 0; r < ranks; ++r)
    for (std::size_t k = 0; k < turn[r].size(); ++k)
      if (turn[r][k]) {
        const Place p = asked_for[r][k];
        std::swap(atom.angle_atom1[p.atom][p.angle], atom.angle_atom3[p.atom][p.angle]);
        ++mine;
      }
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, lmp.world);
  return all;
}

}  // namespace hemomag::lammps
