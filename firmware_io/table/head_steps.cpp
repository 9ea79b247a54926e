// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/table/head_steps.hpp"

#include "calib/beams/angle.hpp"

namespace terracut::table {

std::optional<frame::Reject> HeadSteps::judge(packet::PacketAzimuths& azimuths) noexcept {
  const auto reason = judge_steps(azimuths);
  last_ = {azimuths.device_stamp_us, azimuths.first_cdeg(), true};
  if (!reason) complete(azimuths);
  return reason;
}

std::optional<frame::Reject> HeadSteps::judge_steps(packet::PacketAzimuths& azimuths) noexcept {
  const int most_cdeg = pace_.most_step_cdeg();
  std::int32_t advance_cdeg = 0;
  for (int column = 1; column < azimuths.columns; ++column) {
    const auto c = static_cast<std::size_t>(column);
    const std::int32_t step_cdeg =
        beams::step_cdeg(azimuths.azimuth_cdeg[c - 1], azimuths.azimuth_cdeg[c]);
    advance_cdeg += step_cdeg;
    if (step_cdeg >= -kMaxJitter_cdeg && step_cdeg <= most_cdeg) continue;
    if (azimuths.behind_sector > 0 || step_ticks_ == 0) return frame::Reject::kAzimuthJump;
    azimuths.behind_sector = column;
  }
  if (azimuths.behind_sector > 0) {
    azimuths.step_ticks = step_ticks_;
    return std::nullopt;
  }
  if (advance_cdeg < -kMaxJitter_cdeg) return frame::Reject::kAzimuthJump;
  azimuths.step_ticks = step_of(azimuths, advance_cdeg);
  if (azimuths.step_ticks < kMinStep_cdeg * packet::kTicksPerCdeg) {
    return frame::Reject::kStationary;
  }
  step_ticks_ = azimuths.step_ticks;
  return std::nullopt;
}

/// Returns the step from firing to firing.
std::int32_t HeadSteps::step_of(const packet::PacketAzimuths& azimuths,
                                std::int32_t advance_cdeg) noexcept {
  const int firings = pace_.firings(azimuths.dual_return);
  is_step_guessed_ = false;
  if (firings > 1) return mean_step_ticks(advance_cdeg, firings);
  // A packet of one firing does not show the azimuth step from firing to firing. If no packet was
  // lost before it, the step is the advance of the azimuth since the packet before; else the last
  // known step holds. Before any is known, the step of a sensor at 10 Hz is assumed.
  const std::int64_t since_us =
      packet::clock_step_us(last_.stamp_us, azimuths.device_stamp_us, clock_wrap_us_);
  const bool follows = last_.is_known && since_us > 0 && since_us * 1000 < pace_.column_ns * 3 / 2;
  if (follows) {
    const std::int32_t step_cdeg = beams::step_cdeg(last_.azimuth_cdeg, azimuths.first_cdeg());
    if (step_cdeg <= pace_.most_step_cdeg()) return step_cdeg * packet::kTicksPerCdeg;
  }
  if (step_ticks_ > 0) return step_ticks_;
  is_step_guessed_ = true;
  return pace_.assumed_step_ticks();
}

void HeadSteps::complete(packet::PacketAzimuths& azimuths) const noexcept {
  const std::int32_t firings = pace_.firings(azimuths.dual_return);
  azimuths.pace_ticks = azimuths.widest_ticks = azimuths.step_ticks * firings;
  azimuths.sweep_ticks = azimuths.behind_sector > 0
                             ? azimuths.advance_cdeg(azimuths.columns - 1) * packet::kTicksPerCdeg +
                                   azimuths.step_ticks
                             : azimuths.pace_ticks;
  // While the step is a guess, the sweep is set as wide as it can be; otherwise the gap that a fast
  // head leaves to the next packet would count as a loss.
  if (is_step_guessed_) azimuths.sweep_ticks = pace_.most_step_cdeg() * packet::kTicksPerCdeg;
  azimuths.nominal_period_ns = pace_.column_ns * firings;
  azimuths.shortest_period_ns =
      azimuths.nominal_period_ns - azimuths.nominal_period_ns / packet::kPeriodTolerance;
  azimuths.longest_period_ns =
      azimuths.nominal_period_ns + azimuths.nominal_period_ns / packet::kPeriodTolerance;
}

}  // namespace terracut::table
