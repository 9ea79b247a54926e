// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "ruby128_packet_encoder.hpp"

#include "calib/beams/angle.hpp"

namespace terracut::encode {

void encode_ruby128_packet(
    std::span<const frame::Ruby128Column, ruby128::kRubyBlocksPerPacket> columns, int first_column,
    const Ruby128PacketFacts& facts, ruby128::Ruby128PacketBuffer& packet) noexcept {
  const bool dual = facts.returns == drive::ReturnMode::kDual;
  packet.set_protocol_version(facts.protocol_version);
  packet.set_wave_mode(dual ? ruby128::kRubyFirstReturnBit | ruby128::kRubySecondReturnBit
                            : ruby128::kRubyFirstReturnBit);
  packet.set_temperature_deg_c(facts.temperature_deg_c);
  packet.set_stamp(ruby128::write_ruby_timestamp(columns.front().stamp_ns, facts.timestamp));
  for (int block = 0; block < ruby128::kRubyBlocksPerPacket; ++block) {
    const frame::Ruby128Column& column = columns[static_cast<std::size_t>(block)];
    packet.set_azimuth_cdeg(
        block, static_cast<std::uint16_t>(beams::wrap_cdeg(column.unwrapped_azimuth_cdeg)));
    const int return_of_firing = dual ? (first_column + block) % 2 : 0;
    packet.set_return_id(block, static_cast<std::uint8_t>(1 + return_of_firing));
    for (int channel = 0; channel < ruby128::kRubyChannelsPerBlock; ++channel) {
      const frame::LabelledReturn& beam = column.by_laser[static_cast<std::size_t>(channel)];
      packet.set_return(block, channel, beam.raw, beam.intensity);
    }
  }
}

}  // namespace terracut::encode
