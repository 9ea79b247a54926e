// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware_io/velodyne/velodyne_sensor.hpp"

/// Velodyne's VLP-16, also sold as Puck and Puck LITE (VLP-16 user manual, packet structure and
/// timing; docs/reference/sensors.md).
namespace terracut::velodyne {

struct Vlp16 {
  static constexpr auto kModel = VelodyneModel::kVlp16;
  static constexpr double kMetresPerCount = 0.002;

  /// From one firing of all lasers to the next, and from one laser to the next. They fire one by
  /// one.
  static constexpr std::int32_t kFiring_ns = 55'296, kLaser_ns = 2'304;
  /// Each block holds two firings of all lasers, and the azimuth of the first.
  static constexpr int kLasers = 16, kChannels = 2 * kLasers;
  static constexpr PacketLayout kLayout{.model = sensor::SensorModel::kVlp16,
                                        .block_ids = {hdl64e::kUpperBlockId},
                                        .column_ns = 2 * kFiring_ns,
                                        .firing_ns = kFiring_ns};
  static constexpr int kDefaultColumns = 1808;  ///< 1808.4 firings a frame at 10 Hz.

  static constexpr std::size_t kGroups = kChannels;
  [[nodiscard]] static constexpr std::size_t group(std::size_t channel) noexcept { return channel; }
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    const auto channel = static_cast<std::int32_t>(group);
    return channel / kLasers * kFiring_ns + channel % kLasers * kLaser_ns;
  }
};

using Vlp16Sensor = VelodyneSensor<Vlp16>;

}  // namespace terracut::velodyne
