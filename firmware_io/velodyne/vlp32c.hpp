// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware_io/velodyne/velodyne_sensor.hpp"

/// Velodyne's VLP-32C, also sold as Ultra Puck (VLP-32C user manual, packet structure and timing;
/// docs/reference/sensors.md).
namespace terracut::velodyne {

struct Vlp32c {
  static constexpr auto kModel = VelodyneModel::kVlp32c;
  static constexpr double kMetresPerCount = 0.004;

  /// From one pair of lasers to the next. Both of a pair fire together.
  static constexpr std::int32_t kPair_ns = 2'304;
  static constexpr int kLasers = 32, kChannels = kLasers;
  static constexpr PacketLayout kLayout{.model = sensor::SensorModel::kVlp32c,
                                        .block_ids = {hdl64e::kUpperBlockId},
                                        .column_ns = 55'296,
                                        .firing_ns = 55'296};
  static constexpr int kDefaultColumns = 1808;  ///< 1808.4 firings a frame at 10 Hz.

  static constexpr std::size_t kGroups = kChannels / 2;
  [[nodiscard]] static constexpr std::size_t group(std::size_t channel) noexcept {
    return channel / 2;
  }
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    return static_cast<std::int32_t>(group) * kPair_ns;
  }
};

using Vlp32cSensor = VelodyneSensor<Vlp32c>;

}  // namespace terracut::velodyne
