// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/packet_check.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/packet/sensor_recognition.hpp"
#include "firmware_io/ruby128/firing_azimuth.hpp"

namespace terracut::ruby128 {
namespace {

std::optional<frame::Reject> reject_model(std::span<const std::uint8_t> payload) noexcept {
  switch (sensor::recognise_sensor(payload)) {
    case sensor::SensorModel::kRuby128:
      return std::nullopt;
    case sensor::SensorModel::kRoboSenseDeviceInfo:
      return frame::Reject::kDeviceInfo;
    case sensor::SensorModel::kUnknown:
    case sensor::SensorModel::kOtherRoboSense:  // right leader, but unknown order of blocks
      return payload.size() == kRubyPacketBytes ? frame::Reject::kWrongMagic
                                                : frame::Reject::kWrongSize;
    default:
      return frame::Reject::kWrongModel;
  }
}

/// Completes the fields that follow from the azimuths and the step from firing to firing.
void complete(packet::PacketAzimuths& azimuths) noexcept {
  const auto& cdeg = azimuths.azimuth_cdeg;
  azimuths.dual_return = cdeg[0] == cdeg[1] || cdeg[1] == cdeg[2];
  azimuths.nominal_period_ns =
      kRubyBlocksPerPacket * kRubyBlock_ns / (azimuths.dual_return ? 2 : 1);
  azimuths.shortest_period_ns =
      azimuths.nominal_period_ns - azimuths.nominal_period_ns / packet::kPeriodTolerance;
  azimuths.longest_period_ns =
      azimuths.nominal_period_ns + azimuths.nominal_period_ns / packet::kPeriodTolerance;
  azimuths.pace_ticks = azimuths.step_ticks * kRubyBlocksPerPacket / (azimuths.dual_return ? 2 : 1);
  azimuths.widest_ticks = azimuths.step_ticks * (azimuths.dual_return ? 2 : kRubyBlocksPerPacket);
}

}  // namespace

std::optional<frame::Reject> check_ruby128_packet(std::span<const std::uint8_t> payload,
                                                  packet::PacketAzimuths& azimuths) noexcept {
  if (const auto reason = reject_model(payload)) return reason;
  const auto* packet = packet_in(payload);
  if (packet == nullptr) return frame::Reject::kWrongSize;

  std::array<std::int32_t, kRubyBlocksPerPacket> azimuth_cdeg{};
  azimuths.columns = kRubyBlocksPerPacket;
  azimuths.behind_sector = 0;
  bool in_range = true;
  for (int block = 0; block < kRubyBlocksPerPacket; ++block) {
    const auto b = static_cast<std::size_t>(block);
    azimuth_cdeg[b] = azimuths.azimuth_cdeg[b] = packet->blocks[b].azimuth_cdeg.value();
    in_range &= azimuth_cdeg[b] < beams::kRevolution_cdeg;
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

  azimuths.step_ticks = ruby_step_ticks(azimuth_cdeg);
  azimuths.sweep_ticks = azimuths.step_ticks * ruby_firings(ruby_blocks(azimuth_cdeg));
  complete(azimuths);
  return std::nullopt;
}

bool read_across_sector(packet::PacketAzimuths& azimuths, std::int32_t step_ticks) noexcept {
  if (step_ticks <= 0) return false;
  for (int block = 1; block < kRubyBlocksPerPacket; ++block) {
    const auto b = static_cast<std::size_t>(block);
    const int step_cdeg = beams::step_cdeg(azimuths.azimuth_cdeg[b - 1], azimuths.azimuth_cdeg[b]);
    if (step_cdeg >= -kRubyMaxJitter_cdeg && step_cdeg <= kRubyMaxStep_cdeg) continue;
    if (azimuths.behind_sector > 0) return false;
    azimuths.behind_sector = block;
  }
  azimuths.step_ticks = step_ticks;
  // A firing whose second return is yet to come belongs to the next packet.
  const bool ends_with_half_a_pair = azimuths.azimuth_cdeg[0] == azimuths.azimuth_cdeg[1];
  azimuths.sweep_ticks = azimuths.advance_cdeg(kRubyBlocksPerPacket - 1) * packet::kTicksPerCdeg +
                         (ends_with_half_a_pair ? 0 : step_ticks);
  complete(azimuths);
  return true;
}

std::int64_t ruby_even_stamp_us(std::int64_t stamp_ns, const packet::PacketAzimuths& azimuths,
                                bool rotating) noexcept {
  const bool begins_late =
      rotating && azimuths.dual_return && azimuths.azimuth_cdeg[0] != azimuths.azimuth_cdeg[1];
  const std::int64_t delay_ns = begins_late ? kRubyBlock_ns / 2 : 0;
  constexpr std::int64_t kLatest_ns = std::numeric_limits<std::int64_t>::max() - kRubyBlock_ns;
  return (std::min(stamp_ns, kLatest_ns) + delay_ns) / 1000;
}

}  // namespace terracut::ruby128
