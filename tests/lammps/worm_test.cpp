// Chains of beads with the stiffest bonds the card allows hold together in a field, beside cells.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "case/card.hpp"
#include "support/small_case.hpp"

namespace {

using namespace hemomag;

TEST(Worm, HoldsTogetherJustUnderTheCardsLimit) {
  auto c = test::small_case();
  c.cells[0].count = 1;
  c.carriers[0].kind = case_::CarrierKind::worm;
  c.carriers[0].beads = 8;
  c.carriers[0].count = 3;
  c.magnetic.sources[0].B0 = 0.05;
  c.run.steps = 1000;
  const auto refused = [&](double stretching) {
    c.carriers[0].stretching = stretching;
    return case_::make_card(c, case_::cell_models(c)).refused();
  };
  double stable = 1e-6, unstable = 1e-3;
  ASSERT_FALSE(refused(stable));
  ASSERT_TRUE(refused(unstable));
  for (int k = 0; k < 20; ++k)
    (refused((stable + unstable) / 2) ? unstable : stable) = (stable + unstable) / 2;
  c.carriers[0].stretching = 0.95 * stable;

  const auto system = case_::place(c);
  const auto state = test::run_case_on(MPI_COMM_WORLD, c, system, [](lammps::Host&) {});
  double shortest = 1e9, longest = 0;
  for (std::size_t worm = 0; worm < 3; ++worm)
    for (std::size_t b = 1; b < 8; ++b) {
      const double l = norm(state.x[642 + 8 * worm + b] - state.x[642 + 8 * worm + b - 1]);
      shortest = std::min(shortest, l);
      longest = std::max(longest, l);
    }
  std::printf("bonds of 0.5 nodes with k = %.1f uN/m after 1,000 steps: %.3f to %.3f\n",
              c.carriers[0].stretching * 1e6, shortest, longest);
  EXPECT_GT(shortest, 0.5 * 0.8);
  EXPECT_LT(longest, 0.5 * 1.2);
}

}  // namespace
