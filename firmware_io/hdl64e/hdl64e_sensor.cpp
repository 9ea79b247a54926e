// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/hdl64e_sensor.hpp"

namespace terracut::hdl64e {

Hdl64eSensor::Hdl64eSensor(const Calibration& calibration, const mount::Mount& mount,
                           const Config& config)
    : offsets_(calibration),
      kernel_(calibration, config.geometry, mount),
      metres_per_count_(static_cast<float>(calibration.distance_resolution_m)),
      rows_(rows_by_elevation(calibration)) {}

void Hdl64eSensor::read_column(std::span<const std::uint8_t> payload, std::size_t column,
                               const Returns& found) noexcept {
  const auto* packet = packet_in(payload);
  if (packet == nullptr) return;  // check() has seen to it
  for (std::size_t half = 0; half < 2; ++half) {
    const auto& returns = packet->blocks[2 * column + half].returns;
    const std::size_t first = half * kLasersPerBlock;
    decode::split_returns(&returns[0].distance.bytes[0], decode::ByteOrder::kLittle,
                          found.raw.subspan(first, returns.size()), &found.intensity[first]);
  }
}

}  // namespace terracut::hdl64e
