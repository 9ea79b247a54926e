// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/packet_check.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "firmware_io/ruby128/firing_azimuth.hpp"
#include "firmware_io/ruby128/wire.hpp"
#include "firmware_io/sensor/sensor_model.hpp"

namespace terracut::ruby128 {
namespace {

std::optional<frame::Reject> reject_model(std::span<const std::uint8_t> payload) noexcept {
  switch (sensor::recognise_sensor(payload)) {
    case sensor::SensorModel::kRuby128:
      return std::nullopt;
    case sensor::SensorModel::kRoboSenseDeviceInfo:
      return frame::Reject::kDeviceInfo;
    case sensor::SensorModel::kUnknown:
    case sensor::SensorModel::kOtherRoboSense:  // the right leader, but no known order of blocks
      return payload.size() == kRubyPacketBytes ? frame::Reject::kWrongMagic
                                                : frame::Reject::kWrongSize;
    default:
      return frame::Reject::kWrongModel;
  }
}

/// What follows from the azimuths of a turning head and the step from firing to firing.
void complete(decode::PacketHeads& heads) noexcept {
  const auto& cdeg = heads.azimuth_cdeg;
  heads.dual_return = cdeg[0] == cdeg[1] || cdeg[1] == cdeg[2];
  heads.nominal_period_ns = kRubyBlocksPerPacket * kRubyBlock_ns / (heads.dual_return ? 2 : 1);
  heads.shortest_period_ns =
      heads.nominal_period_ns - heads.nominal_period_ns / decode::kPeriodTolerance;
  heads.longest_period_ns =
      heads.nominal_period_ns + heads.nominal_period_ns / decode::kPeriodTolerance;
  heads.pace_ticks = heads.step_ticks * kRubyBlocksPerPacket / (heads.dual_return ? 2 : 1);
  heads.widest_ticks = heads.step_ticks * (heads.dual_return ? 2 : kRubyBlocksPerPacket);
}

}  // namespace

std::optional<frame::Reject> check_ruby128_packet(std::span<const std::uint8_t> payload,
                                                  decode::PacketHeads& heads) noexcept {
  if (const auto reason = reject_model(payload)) return reason;
  const auto packet = Ruby128PacketView::of(payload);
  if (!packet) return frame::Reject::kWrongSize;

  std::array<std::int32_t, kRubyBlocksPerPacket> azimuth_cdeg{};
  heads.columns = kRubyBlocksPerPacket;
  heads.behind_sector = 0;
  bool in_range = true;
  for (int block = 0; block < kRubyBlocksPerPacket; ++block) {
    const auto b = static_cast<std::size_t>(block);
    azimuth_cdeg[b] = heads.azimuth_cdeg[b] = packet->azimuth_cdeg(block);
    in_range &= azimuth_cdeg[b] < beams::kTurn_cdeg;
  }
  if (!in_range) return frame::Reject::kAzimuthOutOfRange;

  const int first_cdeg = beams::step_cdeg(azimuth_cdeg[0], azimuth_cdeg[1]);
  const int second_cdeg = beams::step_cdeg(azimuth_cdeg[1], azimuth_cdeg[2]);
  for (const int step_cdeg : {first_cdeg, second_cdeg}) {
    if (step_cdeg < -kRubyMaxJitter_cdeg || step_cdeg > kRubyMaxStep_cdeg) {
      return frame::Reject::kAzimuthJump;
    }
  }
  if (first_cdeg + second_cdeg < kRubyMinSweep_cdeg) return frame::Reject::kStationary;

  heads.step_ticks = ruby_step_ticks(azimuth_cdeg);
  heads.sweep_ticks = heads.step_ticks * ruby_firings(ruby_blocks(azimuth_cdeg));
  complete(heads);
  return std::nullopt;
}

bool read_across_sector(decode::PacketHeads& heads, std::int32_t step_ticks) noexcept {
  if (step_ticks <= 0) return false;
  for (int block = 1; block < kRubyBlocksPerPacket; ++block) {
    const auto b = static_cast<std::size_t>(block);
    const int step_cdeg = beams::step_cdeg(heads.azimuth_cdeg[b - 1], heads.azimuth_cdeg[b]);
    if (step_cdeg >= -kRubyMaxJitter_cdeg && step_cdeg <= kRubyMaxStep_cdeg) continue;
    if (heads.behind_sector > 0) return false;
    heads.behind_sector = block;
  }
  heads.step_ticks = step_ticks;
  // The firing of a pair whose second return is yet to come belongs to the next packet.
  const bool ends_with_half_a_pair = heads.azimuth_cdeg[0] == heads.azimuth_cdeg[1];
  heads.sweep_ticks = heads.advance_cdeg(kRubyBlocksPerPacket - 1) * decode::kTicksPerCdeg +
                      (ends_with_half_a_pair ? 0 : step_ticks);
  complete(heads);
  return true;
}

std::int64_t ruby_even_stamp_us(std::int64_t stamp_ns, const decode::PacketHeads& heads,
                                bool turning) noexcept {
  const bool begins_late =
      turning && heads.dual_return && heads.azimuth_cdeg[0] != heads.azimuth_cdeg[1];
  const std::int64_t delay_ns = begins_late ? kRubyBlock_ns / 2 : 0;
  constexpr std::int64_t kLatest_ns = std::numeric_limits<std::int64_t>::max() - kRubyBlock_ns;
  return (std::min(stamp_ns, kLatest_ns) + delay_ns) / 1000;
}

}  // namespace terracut::ruby128
