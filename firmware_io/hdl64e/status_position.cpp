// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/status_position.hpp"

#include <cstdlib>

#include "firmware_io/hdl64e/status_cycle.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"

namespace terracut::hdl64e {
namespace {

// The packet period of every return mode lies between these limits. A packet and the one that is 17
// packets later have adjacent places in the cycle of 16 as well, but they are farther apart in time
// than the longest period.
constexpr std::int64_t kShortestPeriod_us = 100;
constexpr std::int64_t kLongestPeriod_us = 1000;

// The longest gap after which a packet's cycle is certain. Letters tell a packet's number only
// modulo 16, and the period may be wrong by 1 in 288 while it is known from only one pair of stamps
// in whole microseconds.
constexpr std::int64_t kLongestGap_packets = 896;
constexpr std::int64_t kDriftPerPackets = 128;
constexpr std::int64_t kLongestReorder_packets = 64;

constexpr int kStraysThatChangeMode = 8;
constexpr std::int64_t kPeriodMemory = 4096;

/// Returns `place` minus the place of `packet`, the short way round the cycle: [-8, 8).
std::int64_t place_difference(int place, std::int64_t packet) noexcept {
  const auto difference = static_cast<int>((place - packet + 8) % kStatusCyclePackets);
  return (difference < 0 ? difference + kStatusCyclePackets : difference) - 8;
}

}  // namespace

std::int64_t StatusPosition::periods_in(std::int64_t step_us) const noexcept {
  const std::int64_t half = period_sum_us_ / 2;
  const std::int64_t scaled = step_us * period_count_;
  return (scaled >= 0 ? scaled + half : scaled - half) / period_sum_us_;
}

bool StatusPosition::learn_period(std::int64_t step_us) noexcept {
  const std::int64_t off = step_us * period_count_ - period_sum_us_;
  if (std::abs(off) > period_sum_us_ / 10) {
    return ++strays_in_a_row_ < kStraysThatChangeMode;
  }
  strays_in_a_row_ = 0;
  period_sum_us_ += step_us;
  if (++period_count_ >= kPeriodMemory) {
    period_sum_us_ /= 2;
    period_count_ /= 2;
  }
  return true;
}

std::optional<StatusPosition::Located> StatusPosition::restart(std::optional<int> place,
                                                               std::uint32_t stamp_us) noexcept {
  reset();
  if (!place) return std::nullopt;
  locked_ = true;
  newest_packet_ = *place;
  newest_stamp_us_ = stamp_us;
  return Located{newest_packet_, true};
}

std::optional<StatusPosition::Located> StatusPosition::locate(std::optional<int> place,
                                                              std::uint32_t stamp_us) noexcept {
  if (!locked_) return restart(place, stamp_us);
  const std::int64_t step_us = device_step_us(newest_stamp_us_, stamp_us);
  if (step_us == 0) return std::nullopt;

  if (period_count_ == 0) {
    if (!place) return std::nullopt;
    const bool neighbour = step_us >= kShortestPeriod_us && step_us <= kLongestPeriod_us &&
                           place_difference(*place, newest_packet_) == 1;
    if (!neighbour) return restart(place, stamp_us);
    period_sum_us_ = step_us;
    period_count_ = 1;
  }

  const std::int64_t passed = periods_in(step_us);
  if (passed > kLongestGap_packets || passed < -kLongestReorder_packets) {
    return restart(place, stamp_us);
  }
  std::int64_t packet = newest_packet_ + passed;
  if (place) {
    const std::int64_t drift = place_difference(*place, packet);
    if (std::abs(drift) > 1 + std::abs(passed) / kDriftPerPackets) return restart(place, stamp_us);
    packet += drift;
  } else if (packet % kStatusCyclePackets < kFirstTablePlace) {
    return std::nullopt;
  }
  if (packet < 0) return std::nullopt;  // a reordered packet from before the count began

  const bool next_one = packet == newest_packet_ + 1 && place.has_value();
  if (step_us > 0 && packet > newest_packet_) {
    newest_packet_ = packet;
    newest_stamp_us_ = stamp_us;
  }
  if (next_one && step_us >= kShortestPeriod_us && !learn_period(step_us)) {
    return restart(place, stamp_us);
  }
  return Located{packet, false};
}

}  // namespace terracut::hdl64e
