// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firing_assignment.hpp"

namespace terracut::encode {
namespace {

constexpr std::size_t kNone = SIZE_MAX;

/// A return, the firing assigned to it, and the index of the previous pair.
struct Pair {
  std::size_t wanted, fired, before;
};
/// The best assignment that uses only the firings before a given one: its value and its last pair.
struct Way {
  std::int64_t worth = 0;
  std::size_t last = kNone;
};

}  // namespace

std::vector<std::size_t> assign_firings(std::span<const std::int64_t> wanted_ticks,
                                        std::span<const std::int64_t> fired_ticks,
                                        std::int64_t farthest_ticks) {
  // Placing one more return counts more than all shifts together.
  const std::int64_t worth_of_return =
      farthest_ticks * farthest_ticks * (std::ssize(wanted_ticks) + 1);
  std::vector<Pair> pairs;
  std::vector<Way> best(fired_ticks.size() + 1);  // best[n]: using the first n firings
  std::size_t first = 0, end = 0;                 // the firings near enough to this return
  for (std::size_t i = 0; i < wanted_ticks.size(); ++i) {
    const std::int64_t wanted = wanted_ticks[i];
    while (first < fired_ticks.size() && fired_ticks[first] < wanted - farthest_ticks) ++first;
    for (; end < fired_ticks.size() && fired_ticks[end] <= wanted + farthest_ticks; ++end) {
      best[end + 1] = best[end];
    }
    // The loop goes backwards, so that the entries it reads do not include this return yet.
    for (std::size_t firing = end; firing-- > first;) {
      const std::int64_t shift = fired_ticks[firing] - wanted;
      const std::int64_t worth = best[firing].worth + worth_of_return - shift * shift;
      if (worth <= best[firing + 1].worth) continue;
      best[firing + 1] = {worth, pairs.size()};
      pairs.push_back({i, firing, best[firing].last});
    }
    for (std::size_t n = first + 1; n <= end; ++n) {
      if (best[n].worth < best[n - 1].worth) best[n] = best[n - 1];
    }
  }
  std::vector<std::size_t> firing_of(wanted_ticks.size(), kNoFiring);
  for (std::size_t at = best[end].last; at != kNone; at = pairs[at].before) {
    firing_of[pairs[at].wanted] = pairs[at].fired;
  }
  return firing_of;
}

}  // namespace terracut::encode
