// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "hdl64e_packet_encoder.hpp"

#include "calib/beams/angle.hpp"

namespace terracut::encode {

std::int64_t packet_end_ns(
    std::span<const frame::FiringColumn, hdl64e::kColumnsPerPacketSingle> columns) noexcept {
  const std::int64_t first_ns = columns.front().stamp_ns, last_ns = columns.back().stamp_ns;
  const bool dual_return = columns[0].unwrapped_azimuth_cdeg == columns[1].unwrapped_azimuth_cdeg;
  const int firings = dual_return ? hdl64e::kColumnsPerPacketDual : hdl64e::kColumnsPerPacketSingle;
  return last_ns + (last_ns - first_ns) / (firings - 1);
}

void encode_hdl64e_packet(
    std::span<const frame::FiringColumn, hdl64e::kColumnsPerPacketSingle> columns,
    std::int64_t end_stamp_ns, hdl64e::StatusPair status,
    hdl64e::Hdl64ePacketBuffer& packet) noexcept {
  for (int c = 0; c < hdl64e::kColumnsPerPacketSingle; ++c) {
    const frame::FiringColumn& column = columns[static_cast<std::size_t>(c)];
    const auto azimuth_cdeg =
        static_cast<std::uint16_t>(beams::wrap_cdeg(column.unwrapped_azimuth_cdeg));
    packet.set_azimuth_cdeg(2 * c, azimuth_cdeg);
    packet.set_azimuth_cdeg(2 * c + 1, azimuth_cdeg);
    for (int i = 0; i < hdl64e::kHdl64eLasers; ++i) {
      const frame::LabelledReturn& beam = column.by_laser[static_cast<std::size_t>(i)];
      packet.set_return(2 * c + i / hdl64e::kLasersPerBlock, i % hdl64e::kLasersPerBlock, beam.raw,
                        beam.intensity);
    }
  }
  packet.set_stamp_us(static_cast<std::uint32_t>(end_stamp_ns / 1000 % hdl64e::kDeviceHour_us));
  packet.set_status(status.type, status.value);
}

}  // namespace terracut::encode
