// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ouster/ouster_sensor.hpp"

#include <cmath>

namespace terracut::ouster {

Mode mode_of(const OusterCalibration& unit) noexcept {
  return {unit.format, unit.columns_per_frame, unit.rate_hz};
}

std::vector<std::int32_t> beam_ticks(const OusterCalibration& unit) {
  std::vector<std::int32_t> ticks;
  for (const beams::TableBeam& beam : unit.lasers) {
    ticks.push_back(
        static_cast<std::int32_t>(std::lround(beam.azimuth_offset_rad / packet::kRadPerTick)));
  }
  return ticks;
}

mount::RigidTransform T_vehicle_lidar(const OusterCalibration& unit,
                                      const mount::Mount& mount) noexcept {
  const mount::RigidTransform& T = unit.T_sensor_lidar;
  const mount::RigidTransform T_vehicle_sensor = mount::T_vehicle_lidar(mount);
  mount::RigidTransform made{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      double& entry = made[row * 4 + column];
      entry = column == 3 ? T_vehicle_sensor[row * 4 + 3] : 0;
      for (std::size_t i = 0; i < 3; ++i) {
        entry += T_vehicle_sensor[row * 4 + i] * T[i * 4 + column];
      }
    }
  }
  return made;
}

}  // namespace terracut::ouster
