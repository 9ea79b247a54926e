// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/capture_clock.hpp"

#include <algorithm>
#include <cstdlib>

namespace terracut::capture {
namespace {

/// The longest time that the clock counts, four years. Adding two such times cannot overflow.
constexpr std::int64_t kLongest_ns = std::int64_t{1} << 57;

}  // namespace

std::int64_t CaptureClock::add(std::int64_t stamp_ns) noexcept {
  if (!begun_) {
    begun_ = true;
    newest_ = {stamp_ns, 0};
    return 0;
  }
  const std::int64_t step_ns = stamp_ns - newest_.stamp_ns;
  if (step_ns < -kDisorder_ns) {
    ++steps_back_;
    longest_back_ns_ = std::max(longest_back_ns_, -step_ns);
    const bool was_odd = before_ahead_ && newest_.stamp_ns - ahead_stamp_ns_ < kDisorder_ns &&
                         std::abs(stamp_ns - before_ahead_->stamp_ns) < kDisorder_ns;
    newest_ = was_odd ? *before_ahead_ : Instant{stamp_ns, newest_.since_ns};
    before_ahead_.reset();
  } else if (step_ns > kDisorder_ns) {
    before_ahead_ = newest_;
    ahead_stamp_ns_ = stamp_ns;
  }
  const std::int64_t since_ns =
      newest_.since_ns + std::min(stamp_ns - newest_.stamp_ns, kLongest_ns - newest_.since_ns);
  if (stamp_ns > newest_.stamp_ns) newest_ = {stamp_ns, since_ns};
  return since_ns;
}

}  // namespace terracut::capture
