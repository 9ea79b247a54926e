// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firing_order.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

namespace terracut::drive {
namespace {

constexpr std::int64_t kLeastStep_ns = 1'000;  // the device clock must tell packets apart
/// Tighter than the decoder's own limits (stream_tracker.cpp), which know the speed less exactly.
constexpr std::int64_t kGapSlack_cdeg = 1'500;
constexpr std::int64_t kLongestGap_ns = 900'000'000;

tl::unexpected<Error> refuse(std::uint64_t firing, const std::string& what) {
  return fail(ErrorCode::kInvalidArgument, fmt::format("firing {} of the drive: {}", firing, what));
}

}  // namespace

Status FiringOrder::check_step(bool in_group, std::int64_t step_ns, std::int64_t step_cdeg) const {
  if (step_ns < kLeastStep_ns) {
    return refuse(firings_, fmt::format("expected a stamp at least {} ns after the one before, "
                                        "found a step of {} ns",
                                        kLeastStep_ns, step_ns));
  }
  if (in_group && step_ns > limits_.most_step_ns) {
    return refuse(firings_, fmt::format("expected the stamp of a firing inside a packet at most {} "
                                        "ns after the one before, found a step of {} ns",
                                        limits_.most_step_ns, step_ns));
  }
  const std::int64_t least_cdeg = limits_.least_step_cdeg, most_cdeg = limits_.most_step_cdeg;
  if (step_cdeg < least_cdeg || (in_group && step_cdeg > most_cdeg)) {
    return refuse(firings_,
                  fmt::format("expected the head to rotate on by {} to {} hundredths of a degree "
                              "inside a packet and by {} or more between packets, found {}",
                              least_cdeg, most_cdeg, least_cdeg, step_cdeg));
  }
  return {};
}

Status FiringOrder::check_gap(std::int64_t stamp_ns, std::int64_t azimuth_cdeg) const {
  const std::int64_t gap_ns = stamp_ns - group_first_.stamp_ns;
  if (gap_ns > kLongestGap_ns) {
    return refuse(firings_, fmt::format("expected the next packet within {} ms, found a gap of {} "
                                        "ms; write a second drive instead",
                                        kLongestGap_ns / 1'000'000, gap_ns / 1'000'000));
  }
  const std::int64_t gap_cdeg = azimuth_cdeg - group_first_.azimuth_cdeg;
  const std::int64_t group_cdeg = last_.azimuth_cdeg - group_first_.azimuth_cdeg;
  const std::int64_t group_ns = last_.stamp_ns - group_first_.stamp_ns;
  const std::int64_t expected_cdeg = group_cdeg * gap_ns / group_ns;
  if (std::abs(gap_cdeg - expected_cdeg) > kGapSlack_cdeg) {
    return refuse(firings_,
                  fmt::format("the head's speed and the stamps say it rotated by {:.2f} degrees "
                              "since the packet before began, the azimuths say {:.2f}; they may "
                              "differ by {:.0f} degrees",
                              static_cast<double>(expected_cdeg) / 100.0,
                              static_cast<double>(gap_cdeg) / 100.0,
                              static_cast<double>(kGapSlack_cdeg) / 100.0));
  }
  return {};
}

Status FiringOrder::check(std::int64_t stamp_ns, std::int64_t azimuth_cdeg) {
  const bool in_group = firings_ % static_cast<std::uint64_t>(limits_.firings_per_group) != 0;
  if (firings_ > 0) {
    const std::int64_t step_ns = stamp_ns - last_.stamp_ns;
    const std::int64_t step_cdeg = azimuth_cdeg - last_.azimuth_cdeg;
    if (Status followed = check_step(in_group, step_ns, step_cdeg); !followed) return followed;
    if (in_group) {
      step_ns_ = step_ns;
      step_cdeg_ = step_cdeg;
    } else if (Status followed = check_gap(stamp_ns, azimuth_cdeg); !followed) {
      return followed;
    }
  }
  last_ = {stamp_ns, azimuth_cdeg};
  if (!in_group) group_first_ = last_;
  ++firings_;
  return {};
}

Status FiringOrder::check_second_return(std::int64_t stamp_ns, std::int64_t azimuth_cdeg) const {
  if (stamp_ns == last_.stamp_ns && azimuth_cdeg == last_.azimuth_cdeg) return {};
  return refuse(firings_ - 1,
                "expected its second return next, with the same stamp and azimuth as the first");
}

}  // namespace terracut::drive
