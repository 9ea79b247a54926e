// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/encode/firing_assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <utility>

namespace terracut::encode {
namespace {

using Ticks = std::vector<std::int64_t>;
using Firings = std::vector<std::size_t>;

/// Returns with a firing (more is better), then squared shifts (less is better).
using Worth = std::pair<int, std::int64_t>;

Worth worth_of(const Ticks& wanted, const Ticks& fired, const Firings& firing_of) {
  Worth worth{0, 0};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (firing_of[i] == kNoFiring) continue;
    const std::int64_t shift = fired[firing_of[i]] - wanted[i];
    ++worth.first;
    worth.second -= shift * shift;
  }
  return worth;
}

/// By trying all ways there are.
Worth best_worth(const Ticks& wanted, const Ticks& fired, std::int64_t farthest, std::size_t i,
                 std::size_t first_free) {
  if (i == wanted.size()) return {0, 0};
  Worth best = best_worth(wanted, fired, farthest, i + 1, first_free);
  for (std::size_t firing = first_free; firing < fired.size(); ++firing) {
    const std::int64_t shift = fired[firing] - wanted[i];
    if (std::abs(shift) > farthest) continue;
    Worth worth = best_worth(wanted, fired, farthest, i + 1, firing + 1);
    ++worth.first;
    worth.second -= shift * shift;
    best = std::max(best, worth);
  }
  return best;
}

TEST(FiringAssignment, LeavesReturnsWhereTheyAreWhenTheyLieOnFirings) {
  EXPECT_EQ(assign_firings(Ticks{100, 300, 400}, Ticks{0, 100, 200, 300, 400}, 150),
            (Firings{1, 3, 4}));
}

TEST(FiringAssignment, MovesNeighboursApartSoThatEachHasItsOwn) {
  EXPECT_EQ(assign_firings(Ticks{190, 200, 210}, Ticks{0, 100, 200, 300, 400}, 150),
            (Firings{1, 2, 3}));
}

TEST(FiringAssignment, LeavesOutWhatWouldHaveToMoveTooFar) {
  const Firings firing_of = assign_firings(Ticks{200, 200, 200, 200}, Ticks{0, 100, 200, 300}, 150);
  EXPECT_EQ(std::ranges::count(firing_of, kNoFiring), 1);
}

TEST(FiringAssignment, OfNothingIsNothing) {
  EXPECT_EQ(assign_firings({}, Ticks{0, 100}, 150), Firings{});
  EXPECT_EQ(assign_firings(Ticks{50}, {}, 150), Firings{kNoFiring});
}

TEST(FiringAssignment, IsAsGoodAsTheBestOfAllWays) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 400; ++trial) {
    std::uniform_int_distribution<std::int64_t> anywhere(0, 60);
    Ticks wanted(1 + random() % 6), fired(1 + random() % 6);
    for (std::int64_t& ticks : wanted) ticks = anywhere(random);
    for (std::int64_t& ticks : fired) ticks = anywhere(random);
    std::ranges::sort(wanted);
    std::ranges::sort(fired);
    const std::int64_t farthest = 1 + trial % 25;
    const Firings firing_of = assign_firings(wanted, fired, farthest);
    ASSERT_EQ(worth_of(wanted, fired, firing_of), best_worth(wanted, fired, farthest, 0, 0));
    std::size_t first_free = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (firing_of[i] == kNoFiring) continue;
      ASSERT_GE(firing_of[i], first_free) << "out of order, or taken twice";
      ASSERT_LE(std::abs(fired[firing_of[i]] - wanted[i]), farthest);
      first_free = firing_of[i] + 1;
    }
  }
}

}  // namespace
}  // namespace terracut::encode
