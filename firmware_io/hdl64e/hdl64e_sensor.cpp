// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/hdl64e_sensor.hpp"

namespace terracut::hdl64e {

Hdl64eSensor::Hdl64eSensor(const Calibration& calibration, const mount::Mount& mount,
                           const Config& config, int columns, memory::FixedMemory& memory)
    : offsets_(calibration),
      kernel_(calibration, config.geometry, mount, columns, memory),
      rows_(rows_by_elevation(calibration)) {}

void Hdl64eSensor::begin_packet(const decode::PacketAzimuths& azimuths) noexcept {
  std::array<std::int32_t, kLasersPerBlock> advance_ticks;
  std::array<std::int32_t, kHdl64eLasers> offset_ticks;
  for (int j = 0; j < kLasersPerBlock; ++j) {
    advance_ticks[static_cast<std::size_t>(j)] =
        firing_advance_ticks(azimuths.step_ticks, j, azimuths.dual_return);
  }
  for (int i = 0; i < kRows; ++i) {
    offset_ticks[static_cast<std::size_t>(i)] =
        offsets_.offset_ticks(azimuths.step_ticks, i, azimuths.dual_return);
  }
  kernel_.begin_packet(advance_ticks, offset_ticks);
}

void Hdl64eSensor::read_column(std::span<const std::uint8_t> payload,
                               const decode::PacketAzimuths& azimuths, int column,
                               Column& found) noexcept {
  if (const auto* packet = packet_in(payload)) {  // check() has seen to it
    for (std::size_t half = 0; half < 2; ++half) {
      const auto& returns = packet->blocks[2 * static_cast<std::size_t>(column) + half].returns;
      const std::size_t first = half * kLasersPerBlock;
      for (std::size_t j = 0; j < returns.size(); ++j) {
        found.raw[first + j] = returns[j].distance.value();
        found.intensity[first + j] = returns[j].intensity;
      }
    }
  }
  kernel_.compute(azimuths.azimuth_cdeg[static_cast<std::size_t>(column)], found);
}

}  // namespace terracut::hdl64e
