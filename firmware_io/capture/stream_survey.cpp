// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/stream_survey.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "calib/angle.hpp"

namespace terracut::firmware_io {
namespace {

constexpr std::int64_t kJump_us = 10'000'000;
/// Less than half a turn at the fastest spin (20 Hz), so that the short way round is the true one.
constexpr std::int64_t kSurelyUnderHalfATurn_us = 20'000;
constexpr std::int64_t kShortestPeriod_us = 50;
constexpr std::int64_t kLongestPeriod_us = 1'000;
/// Bounds the memory a senseless capture can take.
constexpr std::size_t kMostDistinctSteps = 100'000;

}  // namespace

std::string_view to_string(ReturnMode mode) noexcept {
  switch (mode) {
    case ReturnMode::kUnknown:
      return "unknown";
    case ReturnMode::kSingle:
      return "single";
    case ReturnMode::kDual:
      return "dual";
  }
  return "unknown";
}

void StreamSurvey::add(const PacketHeads& heads, bool turning) {
  ++facts_.packets;
  if (turning) {
    ++turning_packets_;
    steps_ticks_ += heads.step_ticks;
    dual_packets_ += heads.dual_return ? 1 : 0;
  }
  add_step(heads);
}

void StreamSurvey::add_step(const PacketHeads& heads) {
  if (newest_) {
    std::int64_t step_us = (heads.device_stamp_us - newest_->device_stamp_us) % clock_wrap_us_;
    if (step_us >= clock_wrap_us_ / 2) step_us -= clock_wrap_us_;
    if (step_us < -(clock_wrap_us_ / 2)) step_us += clock_wrap_us_;
    if (step_us == 0) {
      ++facts_.packets_repeated;
      return;
    }
    if (step_us < 0 && step_us > -kJump_us) {
      ++facts_.packets_reordered;
      return;
    }
    if (std::abs(step_us) >= kJump_us) {
      ++facts_.clock_jumps;
    } else {
      if (steps_us_.size() < kMostDistinctSteps || steps_us_.contains(step_us))
        ++steps_us_[step_us];
      if (step_us < kSurelyUnderHalfATurn_us) {
        short_time_us_ += step_us;
        short_advance_cdeg_ += calib::step_cdeg(newest_->first_cdeg(), heads.first_cdeg());
      } else {
        long_time_us_ += step_us;
      }
    }
  }
  newest_ = heads;
}

/// Mean of the steps near the median of those that can be one period.
double StreamSurvey::period_us() const {
  const auto first = steps_us_.lower_bound(kShortestPeriod_us);
  const auto last = steps_us_.upper_bound(kLongestPeriod_us);
  std::uint64_t total = 0;
  for (auto step = first; step != last; ++step) total += step->second;
  if (total == 0) return 0;
  auto median = first;
  for (std::uint64_t below = 0; (below += median->second) * 2 <= total;) ++median;
  double sum_us = 0;
  double count = 0;
  for (auto step = first; step != last; ++step) {
    if (std::abs(step->first - median->first) * 20 > median->first) continue;
    sum_us += static_cast<double>(step->first) * static_cast<double>(step->second);
    count += static_cast<double>(step->second);
  }
  return sum_us / count;
}

StreamFacts StreamSurvey::facts() const {
  StreamFacts facts = facts_;
  facts.packet_period_us = period_us();
  if (facts.packet_period_us > 0) {
    for (const auto& [step_us, count] : steps_us_) {
      const auto periods = static_cast<std::uint64_t>(
          std::llround(static_cast<double>(step_us) / facts.packet_period_us));
      // A packet put back in order fills a gap that was counted when the later one overtook it.
      if (periods > 1) facts.packets_lost += (periods - 1) * count;
    }
    facts.packets_lost -= std::min(facts.packets_lost, facts.packets_reordered);
  }
  if (turning_packets_ > 0) {
    facts.return_mode =
        dual_packets_ * 2 > turning_packets_ ? ReturnMode::kDual : ReturnMode::kSingle;
    facts.step_deg =
        static_cast<double>(steps_ticks_) / static_cast<double>(turning_packets_) * 1e-5;
  }
  if (short_time_us_ > 0) {
    const double cdeg_per_us =
        static_cast<double>(short_advance_cdeg_) / static_cast<double>(short_time_us_);
    facts.spin_rpm = cdeg_per_us * 60e6 / calib::kTurn_cdeg;
    facts.turns =
        cdeg_per_us * static_cast<double>(short_time_us_ + long_time_us_) / calib::kTurn_cdeg;
  }
  return facts;
}

}  // namespace terracut::firmware_io
