// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/s1_packet.hpp"

#include "firmware_io/hdl64e/packet_check.hpp"

namespace terracut::hdl64e {

std::optional<frame::Reject> check_hdl64e_s1_packet(const wire::Packet& packet,
                                                    packet::PacketAzimuths& azimuths) noexcept {
  azimuths.columns = kColumnsPerPacketS1;
  azimuths.dual_return = false;
  bool in_range = true;
  for (std::size_t block = 0; block < packet.blocks.size(); ++block) {
    azimuths.azimuth_cdeg[block] = packet.blocks[block].azimuth_cdeg.value();
    in_range &= azimuths.azimuth_cdeg[block] < beams::kRevolution_cdeg;
  }
  if (!in_range) return frame::Reject::kAzimuthOutOfRange;

  int advance_cdeg = 0;
  for (std::size_t block = 1; block < packet.blocks.size(); ++block) {
    const int step_cdeg =
        beams::step_cdeg(azimuths.azimuth_cdeg[block - 1], azimuths.azimuth_cdeg[block]);
    if (step_cdeg < -kMaxJitter_cdeg || step_cdeg > kMaxColumnStep_cdeg) {
      return frame::Reject::kAzimuthJump;
    }
    advance_cdeg += step_cdeg;
  }
  if (advance_cdeg <= -kMinSweep_cdeg) return frame::Reject::kAzimuthJump;
  if (advance_cdeg < kMinSweep_cdeg) return frame::Reject::kStationary;

  azimuths.step_ticks = advance_cdeg * packet::kTicksPerCdeg / (kColumnsPerPacketS1 - 1);
  azimuths.pace_ticks = azimuths.step_ticks * kColumnsPerPacketS1;
  // The azimuth of the next packet may be one encoder mark beyond the mean step.
  constexpr std::int32_t kHalfMark_ticks = kS1Mark_cdeg * packet::kTicksPerCdeg / 2;
  azimuths.sweep_ticks = azimuths.pace_ticks + kHalfMark_ticks;
  azimuths.widest_ticks = azimuths.sweep_ticks;
  azimuths.nominal_period_ns = kS1Packet_ns;
  azimuths.shortest_period_ns = kS1Packet_ns - kS1Packet_ns / packet::kPeriodTolerance;
  azimuths.longest_period_ns = kS1Packet_ns + kS1Packet_ns / packet::kPeriodTolerance;
  return std::nullopt;
}

}  // namespace terracut::hdl64e
