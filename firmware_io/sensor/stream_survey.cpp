// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/stream_survey.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "calib/beams/angle.hpp"

namespace terracut::sensor {
namespace {

constexpr std::int64_t kJump_us = 10'000'000;
/// In this time the head makes less than half a revolution even at 20 Hz, so of two possible
/// rotations the shorter is the true one.
constexpr std::int64_t kSurelyUnderHalfARevolution_us = 20'000;
constexpr std::int64_t kShortestPeriod_us = 50;
constexpr std::int64_t kLongestPeriod_us = 3'500;  ///< An Ouster's are 3125 us in mode 512x10.
/// Bounds the memory that a senseless capture can take.
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

void StreamSurvey::add(const packet::PacketAzimuths& azimuths, bool rotating) {
  ++facts_.packets;
  if (rotating) {
    ++rotating_packets_;
    steps_ticks_ += azimuths.step_ticks;
    dual_packets_ += azimuths.dual_return ? 1 : 0;
  }
  add_step(azimuths, rotating);
}

void StreamSurvey::add_step(const packet::PacketAzimuths& azimuths, bool rotating) {
  bool goes_on = false;
  if (newest_) {
    const std::int64_t step_us =
        packet::clock_step_us(newest_->device_stamp_us, azimuths.device_stamp_us, clock_wrap_us_);
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
      seen_.reset();
      blind_.end();
    } else {
      goes_on = rotating && seen_;
      const bool is_told = goes_on && follow(azimuths, step_us);
      const bool is_known = steps_us_.size() < kMostDistinctSteps || steps_us_.contains(step_us);
      if (!is_told && is_known) ++steps_us_[step_us];
      if (step_us < kSurelyUnderHalfARevolution_us) {
        short_time_us_ += step_us;
        short_advance_cdeg_ += beams::step_cdeg(newest_->first_cdeg(), azimuths.first_cdeg());
      } else {
        long_time_us_ += step_us;
      }
    }
  }
  if (rotating && !goes_on) begin_rotating(azimuths);
  if (!rotating) ++not_rotating_;
  newest_ = azimuths;
}

void StreamSurvey::begin_rotating(const packet::PacketAzimuths& azimuths) {
  seen_ = {azimuths.device_stamp_us, azimuths.first_cdeg(), azimuths.behind_sector > 0};
  frontier_ticks_ =
      std::int64_t{azimuths.first_cdeg()} * packet::kTicksPerCdeg + azimuths.sweep_ticks;
  not_rotating_ = 0;
}

bool StreamSurvey::follow(const packet::PacketAzimuths& azimuths, std::int64_t step_us) {
  const double nominal_us = azimuths.nominal_period_ns * 1e-3;
  const double step_periods = static_cast<double>(step_us) / nominal_us;
  const double measured_us = step_periods > 2 ? period_us() : 0;
  const double one_us = measured_us > 0 ? measured_us : nominal_us;
  const std::int64_t since_us =
      packet::clock_step_us(seen_->stamp_us, azimuths.device_stamp_us, clock_wrap_us_);
  const auto expected_cdeg =
      seen_->rotor_cdeg + std::llround(static_cast<double>(since_us) / one_us *
                                       azimuths.pace_ticks / packet::kTicksPerCdeg);
  const std::int64_t rotor_cdeg =
      expected_cdeg + beams::step_cdeg(beams::wrap_cdeg(expected_cdeg), azimuths.first_cdeg());

  const std::int64_t begin_ticks = rotor_cdeg * packet::kTicksPerCdeg;
  const packet::RotorInterval gap{frontier_ticks_, begin_ticks};
  const packet::RotorInterval swept{begin_ticks, begin_ticks + azimuths.sweep_ticks};
  const decode::BlindSector::Stride stride{azimuths.pace_ticks, azimuths.widest_ticks};
  const bool is_wide = gap.ticks() >= blind_.least_ticks();
  if (is_wide || seen_->has_sector) {
    std::int64_t missing = std::max(0LL, std::llround(static_cast<double>(step_us) / one_us) - 1);
    // The time of the step includes the blind sector, but the azimuths of the gap begin behind it.
    if (seen_->has_sector) {
      missing = std::min(missing, (gap.ticks() + azimuths.pace_ticks / 2) / azimuths.pace_ticks);
    }
    lost_in_gaps_ += is_wide ? blind_.judge(gap, missing, not_rotating_, stride).packets : missing;
  }
  if (azimuths.behind_sector > 0) {
    lost_in_gaps_ += blind_.cross(begin_ticks, azimuths.sector_inside(begin_ticks), stride).packets;
  } else {
    blind_.pass(swept);
  }
  lost_in_gaps_ += blind_.take_due().packets;
  const bool is_told = is_wide || seen_->has_sector;
  seen_ = {azimuths.device_stamp_us, rotor_cdeg, azimuths.behind_sector > 0};
  frontier_ticks_ = std::max(frontier_ticks_, swept.to_ticks);
  not_rotating_ = 0;
  return is_told;
}

/// Returns the mean of the steps near the median, considering only steps short enough to be one
/// period.
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
      if (periods > 1) facts.packets_lost += (periods - 1) * count;
    }
  }
  decode::BlindSector to_the_end = blind_;
  to_the_end.end();
  facts.packets_lost += static_cast<std::uint64_t>(lost_in_gaps_ + to_the_end.take_due().packets);
  // A reordered packet fills a gap that was counted when a later packet overtook it.
  facts.packets_lost -= std::min(facts.packets_lost, facts.packets_reordered);
  facts.blind = decode::blind_azimuths(blind_.sector());
  if (rotating_packets_ > 0) {
    facts.return_mode =
        dual_packets_ * 2 > rotating_packets_ ? ReturnMode::kDual : ReturnMode::kSingle;
    facts.step_deg =
        static_cast<double>(steps_ticks_) / static_cast<double>(rotating_packets_) * 1e-5;
  }
  if (short_time_us_ > 0) {
    const double cdeg_per_us =
        static_cast<double>(short_advance_cdeg_) / static_cast<double>(short_time_us_);
    facts.spin_rpm = cdeg_per_us * 60e6 / beams::kRevolution_cdeg;
    facts.frames =
        cdeg_per_us * static_cast<double>(short_time_us_ + long_time_us_) / beams::kRevolution_cdeg;
  }
  return facts;
}

}  // namespace terracut::sensor
