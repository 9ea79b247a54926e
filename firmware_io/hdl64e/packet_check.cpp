// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/packet_check.hpp"

#include <algorithm>

#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"

namespace terracut::hdl64e {
namespace {

std::optional<frame::Reject> reject_ids(const wire::Packet& packet) noexcept {
  int upper = 0, lower = 0, others = 0, misplaced = 0;
  for (std::size_t block = 0; block < packet.blocks.size(); ++block) {
    const std::uint16_t id = packet.blocks[block].id.value();
    upper += id == kUpperBlockId;
    lower += id == kLowerBlockId;
    others += id == kVls128ThirdId || id == kVls128FourthId;
    misplaced += id != (block % 2 == 0 ? kUpperBlockId : kLowerBlockId);
  }
  if (misplaced == 0) return std::nullopt;
  const bool all_known = upper + lower + others == kBlocksPerPacket;
  const bool smaller_model = upper == kBlocksPerPacket;
  const bool vls128 = all_known && others > 0 && upper > 0;
  const bool hdl64e_s1 = upper + lower == kBlocksPerPacket && lower > 0 && upper >= 2 * lower;
  return smaller_model || vls128 || hdl64e_s1 ? frame::Reject::kWrongModel
                                              : frame::Reject::kWrongMagic;
}

bool is_ruby(std::span<const std::uint8_t> payload) noexcept {
  return payload.size() == ruby128::kRubyPacketBytes &&
         std::equal(ruby128::kRubyMagic.begin(), ruby128::kRubyMagic.end(), payload.begin());
}

}  // namespace

std::optional<frame::Reject> check_hdl64e_packet(std::span<const std::uint8_t> payload,
                                                 packet::PacketAzimuths& azimuths) noexcept {
  const auto* packet = packet_in(payload);
  if (packet == nullptr)
    return is_ruby(payload) ? frame::Reject::kWrongModel : frame::Reject::kWrongSize;
  if (const auto reason = reject_ids(*packet)) return reason;

  azimuths.device_stamp_us = packet->stamp_us.value() % kDeviceHour_us;
  azimuths.columns = kColumnsPerPacketSingle;
  bool in_range = true, pairs_agree = true;
  for (std::size_t column = 0; column < kColumnsPerPacketSingle; ++column) {
    const int azimuth_cdeg = packet->blocks[2 * column].azimuth_cdeg.value();
    const int lower_cdeg = packet->blocks[2 * column + 1].azimuth_cdeg.value();
    in_range &= azimuth_cdeg < beams::kRevolution_cdeg && lower_cdeg < beams::kRevolution_cdeg;
    pairs_agree &= azimuth_cdeg == lower_cdeg;
    azimuths.azimuth_cdeg[column] = azimuth_cdeg;
  }
  if (!in_range) return frame::Reject::kAzimuthOutOfRange;
  if (!pairs_agree) return frame::Reject::kAzimuthMismatch;

  const auto& azimuth_cdeg = azimuths.azimuth_cdeg;
  int sweep_cdeg = 0;
  for (std::size_t column = 1; column < kColumnsPerPacketSingle; ++column) {
    const int step_cdeg = beams::step_cdeg(azimuth_cdeg[column - 1], azimuth_cdeg[column]);
    if (step_cdeg < -kMaxJitter_cdeg || step_cdeg > kMaxColumnStep_cdeg) {
      return frame::Reject::kAzimuthJump;
    }
    sweep_cdeg += step_cdeg;
  }
  if (sweep_cdeg <= -kMinSweep_cdeg) return frame::Reject::kAzimuthJump;
  if (sweep_cdeg < kMinSweep_cdeg) return frame::Reject::kStationary;

  azimuths.dual_return = azimuth_cdeg[0] == azimuth_cdeg[1] && azimuth_cdeg[2] == azimuth_cdeg[3] &&
                         azimuth_cdeg[4] == azimuth_cdeg[5];
  azimuths.step_ticks = column_step_ticks(azimuth_cdeg[0], azimuth_cdeg[5], azimuths.dual_return);
  const FiringTimes& usual = azimuths.dual_return ? kFiringTimesDual : kFiringTimesSingle48;
  const FiringTimes& slowest = azimuths.dual_return ? kFiringTimesDual : kFiringTimesSingle57;
  azimuths.nominal_period_ns = usual.packet_ns();
  azimuths.shortest_period_ns = usual.packet_ns() - usual.packet_ns() / packet::kPeriodTolerance;
  azimuths.longest_period_ns = slowest.packet_ns() + slowest.packet_ns() / packet::kPeriodTolerance;
  azimuths.sweep_ticks = azimuths.step_ticks *
                         (azimuths.dual_return ? kColumnsPerPacketDual : kColumnsPerPacketSingle);
  azimuths.pace_ticks = azimuths.widest_ticks = azimuths.sweep_ticks;
  return std::nullopt;
}

}  // namespace terracut::hdl64e
