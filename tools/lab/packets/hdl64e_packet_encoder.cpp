// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/packets/hdl64e_packet_encoder.hpp"

#include "calib/beams/angle.hpp"

namespace terracut::packets {

std::int64_t packet_end_ns(
    std::span<const FiringColumn, hdl64e::kColumnsPerPacketSingle> columns) noexcept {
  const std::int64_t first_ns = columns.front().stamp_ns, last_ns = columns.back().stamp_ns;
  const bool dual_return = columns[0].unwrapped_azimuth_cdeg == columns[1].unwrapped_azimuth_cdeg;
  const int firings = dual_return ? hdl64e::kColumnsPerPacketDual : hdl64e::kColumnsPerPacketSingle;
  return last_ns + (last_ns - first_ns) / (firings - 1);
}

void encode_hdl64e_packet(std::span<const FiringColumn, hdl64e::kColumnsPerPacketSingle> columns,
                          std::int64_t end_stamp_ns, hdl64e::StatusPair status,
                          hdl64e::wire::Packet& packet) noexcept {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const FiringColumn& column = columns[c];
    for (std::size_t half = 0; half < 2; ++half) {
      hdl64e::wire::Block& block = packet.blocks[2 * c + half];
      block.azimuth_cdeg =
          static_cast<std::uint16_t>(beams::wrap_cdeg(column.unwrapped_azimuth_cdeg));
      for (std::size_t j = 0; j < block.returns.size(); ++j) {
        const LabelledReturn& beam = column.by_laser[half * hdl64e::kLasersPerBlock + j];
        block.returns[j] = {packet::Le16::of(beam.raw), beam.intensity};
      }
    }
  }
  packet.stamp_us = static_cast<std::uint32_t>(end_stamp_ns / 1000 % hdl64e::kDeviceHour_us);
  packet.status_type = status.type;
  packet.status_value = status.value;
}

}  // namespace terracut::packets
