// The same small case (cells across rank and periodic borders, carriers, field) on 1, 2 and 4
// ranks.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "support/small_case.hpp"

namespace {

using namespace hemomag;

TEST(RankCount, ResultsAgreeAfter200Steps) {
  int rank = 0, ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  ASSERT_GE(ranks, 4);
  const auto c = test::small_case();
  const auto system = case_::place(c);
  std::vector<test::State> states;
  for (const int n : {1, 2, 4}) {
    MPI_Comm some = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank < n ? 0 : MPI_UNDEFINED, rank, &some);
    if (some != MPI_COMM_NULL) {
      states.push_back(test::run_case_on(some, c, system, [](lammps::Host&) {}));
      MPI_Comm_free(&some);
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  if (rank != 0) return;
  ASSERT_EQ(states.size(), 3u);
  ASSERT_EQ(states[0].x.size(), 2u * 642 + 12);
  // The case must cross the borders it is about.
  bool crosses = false;
  for (std::size_t k = 0; k < 1284; ++k)
    crosses = crosses || states[0].x[k].y < 0 || states[0].x[k].y > 28 || states[0].x[k].x < 0 ||
              states[0].x[k].x > 18;
  EXPECT_TRUE(crosses) << "no cell lies across a periodic border";
  for (std::size_t s = 1; s < 3; ++s) {
    double worst = 0;
    for (std::size_t k = 0; k < states[0].x.size(); ++k)
      worst = std::max(worst, norm(states[s].x[k] - states[0].x[k]));
    const double scale = 28;  // the box, in nodes
    std::printf(
        "%d ranks against 1: largest difference of a position %.2e of the box, tolerance 1e-10\n",
        s == 1 ? 2 : 4, worst / scale);
    EXPECT_LT(worst / scale, 1e-10);
  }
}

}  // namespace
