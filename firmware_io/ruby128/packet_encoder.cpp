// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/packet_encoder.hpp"

#include "calib/angle.hpp"

namespace terracut::firmware_io {

void encode_ruby128_packet(std::span<const Ruby128Column, kRubyBlocksPerPacket> columns,
                           int first_column, const Ruby128PacketFacts& facts,
                           Ruby128PacketBuffer& packet) noexcept {
  const bool dual = facts.returns == ReturnMode::kDual;
  packet.set_protocol_version(facts.protocol_version);
  packet.set_wave_mode(dual ? kRubyFirstReturnBit | kRubySecondReturnBit : kRubyFirstReturnBit);
  packet.set_temperature_deg_c(facts.temperature_deg_c);
  packet.set_stamp(write_ruby_timestamp(columns.front().stamp_ns, facts.timestamp));
  for (int block = 0; block < kRubyBlocksPerPacket; ++block) {
    const Ruby128Column& column = columns[static_cast<std::size_t>(block)];
    packet.set_azimuth_cdeg(
        block, static_cast<std::uint16_t>(calib::wrap_cdeg(column.unwrapped_azimuth_cdeg)));
    const int return_of_firing = dual ? (first_column + block) % 2 : 0;
    packet.set_return_id(block, static_cast<std::uint8_t>(1 + return_of_firing));
    for (int channel = 0; channel < kRubyChannelsPerBlock; ++channel) {
      const LabelledReturn& echo = column.by_laser[static_cast<std::size_t>(channel)];
      packet.set_return(block, channel, echo.raw, echo.intensity);
    }
  }
}

}  // namespace terracut::firmware_io
