// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "stamp_gaps.hpp"

#include <algorithm>
#include <utility>

namespace terracut::cli {

std::uint64_t StampGaps::missing_before(std::int64_t stamp_ns) noexcept {
  constexpr std::int64_t kSilence_ns = 1'000'000'000;
  const std::int64_t before_ns = std::exchange(before_ns_, stamp_ns);
  if (before_ns <= 0 || stamp_ns <= before_ns) return 0;
  const std::int64_t interval_ns = stamp_ns - before_ns;
  if (interval_ns >= kSilence_ns) return 0;
  intervals_ns_[came_++ % kIntervals] = interval_ns;
  if (came_ < kFewest) return 0;
  const std::int64_t period_ns = this->period_ns();
  return static_cast<std::uint64_t>(
      std::max<std::int64_t>((interval_ns + period_ns / 2) / period_ns - 1, 0));
}

std::int64_t StampGaps::period_ns() const noexcept {
  const std::size_t known = std::min(came_, kIntervals);
  auto sorted = intervals_ns_;
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(known);
  const auto quarter = sorted.begin() + static_cast<std::ptrdiff_t>(known / 4);
  std::nth_element(sorted.begin(), quarter, end);
  return *quarter;
}

}  // namespace terracut::cli
