#include "lammps/orient_triangles.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "lammps.h"

#include "membrane/orientation.hpp"
#include "solver/rendezvous.hpp"

namespace hemomag::lammps {
namespace {

struct Listed {
  std::int64_t cell;
  std::array<std::int64_t, 3> triangle;
};

struct Place {
  int atom, angle;
};

}  // namespace

LAMMPS_NS::bigint orient_triangles(LAMMPS_NS::LAMMPS& lmp, const int* is_triangle) {
  auto& atom = *lmp.atom;
  const auto ranks = static_cast<std::size_t>(lmp.comm->nprocs);
  std::vector<std::vector<Listed>> ask(ranks);
  std::vector<std::vector<Place>> asked_for(ranks);
  for (int i = 0; i < atom.nlocal; ++i)
    for (int n = 0; n < atom.num_angle[i]; ++n) {
      if (!is_triangle[atom.angle_type[i][n]]) continue;
      const auto keeper = static_cast<std::size_t>(atom.molecule[i]) % ranks;
      ask[keeper].push_back(
          {atom.molecule[i],
           {atom.angle_atom1[i][n], atom.angle_atom2[i][n], atom.angle_atom3[i][n]}});
      asked_for[keeper].push_back({i, n});
    }

  const auto asked = solver::exchange_by_rank(lmp.world, ask);
  std::map<std::int64_t, std::vector<std::pair<std::size_t, std::size_t>>>
      cells;  // (rank, question)
  std::vector<std::vector<char>> answer(ranks);
  for (std::size_t r = 0; r < ranks; ++r) {
    answer[r].resize(asked[r].size());
    for (std::size_t k = 0; k < asked[r].size(); ++k) cells[asked[r][k].cell].push_back({r, k});
  }
  for (const auto& [cell, questions] : cells) {
    std::vector<std::array<std::int64_t, 3>> triangles;
    for (const auto& [r, k] : questions) triangles.push_back(asked[r][k].triangle);
    const auto turn = membrane::triangles_to_turn(triangles);
    for (std::size_t q = 0; q < questions.size(); ++q)
      answer[questions[q].first][questions[q].second] = turn[q];
  }

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
