// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/packets/ruby128_packet_encoder.hpp"

#include "calib/beams/angle.hpp"

namespace terracut::packets {

void encode_ruby128_packet(std::span<const Ruby128Column, ruby128::kRubyBlocksPerPacket> columns,
                           int first_column, const Ruby128PacketFacts& facts,
                           ruby128::ruby128_wire::Packet& packet) noexcept {
  const bool dual = facts.returns == ReturnMode::kDual;
  packet.protocol_version = facts.protocol_version;
  packet.wave_mode = dual ? ruby128::kRubyFirstReturnBit | ruby128::kRubySecondReturnBit
                          : ruby128::kRubyFirstReturnBit;
  packet.temperature = ruby128::ruby_temperature_field(facts.temperature_deg_c);
  packet.stamp = ruby128::write_ruby_timestamp(columns.front().stamp_ns, facts.timestamp);
  for (std::size_t b = 0; b < columns.size(); ++b) {
    const Ruby128Column& column = columns[b];
    ruby128::ruby128_wire::Block& block = packet.blocks[b];
    block.azimuth_cdeg =
        static_cast<std::uint16_t>(beams::wrap_cdeg(column.unwrapped_azimuth_cdeg));
    const int return_of_firing = dual ? (first_column + static_cast<int>(b)) % 2 : 0;
    block.return_id = static_cast<std::uint8_t>(1 + return_of_firing);
    for (std::size_t channel = 0; channel < block.returns.size(); ++channel) {
      const LabelledReturn& beam = column.by_laser[channel];
      block.returns[channel] = {packet::Be16::of(beam.raw), beam.intensity};
    }
  }
}

}  // namespace terracut::packets
