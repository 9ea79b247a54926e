// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/packet_encoder.hpp"

#include "calib/angle.hpp"

namespace terracut::firmware_io {

std::int64_t packet_end_ns(
    std::span<const FiringColumn, kColumnsPerPacketSingle> columns) noexcept {
  const std::int64_t first_ns = columns.front().stamp_ns, last_ns = columns.back().stamp_ns;
  const bool dual_return = columns[0].unwrapped_azimuth_cdeg == columns[1].unwrapped_azimuth_cdeg;
  const int firings = dual_return ? kColumnsPerPacketDual : kColumnsPerPacketSingle;
  return last_ns + (last_ns - first_ns) / (firings - 1);
}

void encode_hdl64e_packet(std::span<const FiringColumn, kColumnsPerPacketSingle> columns,
                          std::int64_t end_stamp_ns, StatusPair status,
                          Hdl64ePacketBuffer& packet) noexcept {
  for (int c = 0; c < kColumnsPerPacketSingle; ++c) {
    const FiringColumn& column = columns[static_cast<std::size_t>(c)];
    const auto azimuth_cdeg =
        static_cast<std::uint16_t>(calib::wrap_cdeg(column.unwrapped_azimuth_cdeg));
    packet.set_azimuth_cdeg(2 * c, azimuth_cdeg);
    packet.set_azimuth_cdeg(2 * c + 1, azimuth_cdeg);
    for (int i = 0; i < calib::kHdl64eLasers; ++i) {
      const LabelledReturn& echo = column.by_laser[static_cast<std::size_t>(i)];
      packet.set_return(2 * c + i / kLasersPerBlock, i % kLasersPerBlock, echo.raw, echo.intensity);
    }
  }
  packet.set_stamp_us(static_cast<std::uint32_t>(end_stamp_ns / 1000 % kDeviceHour_us));
  packet.set_status(status.type, status.value);
}

}  // namespace terracut::firmware_io
