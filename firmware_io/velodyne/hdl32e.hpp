// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware_io/velodyne/velodyne_sensor.hpp"

/// Velodyne's HDL-32E (HDL-32E application note, packet structure and timing;
/// docs/reference/sensors.md).
namespace terracut::velodyne {

struct Hdl32e {
  static constexpr auto kModel = VelodyneModel::kHdl32e;
  static constexpr double kMetresPerCount = 0.002;

  /// From one laser to the next; they fire one by one.
  static constexpr std::int32_t kLaser_ns = 1'152;
  static constexpr int kLasers = 32, kChannels = kLasers;
  static constexpr PacketLayout kLayout{.model = sensor::SensorModel::kHdl32e,
                                        .block_ids = {hdl64e::kUpperBlockId},
                                        .column_ns = 46'080,
                                        .firing_ns = 46'080};
  static constexpr int kDefaultColumns = 2170;  ///< 2170.1 firings a frame at 10 Hz.

  static constexpr std::size_t kGroups = kChannels;
  [[nodiscard]] static constexpr std::size_t group(std::size_t channel) noexcept { return channel; }
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    return static_cast<std::int32_t>(group) * kLaser_ns;
  }
};

using Hdl32eSensor = VelodyneSensor<Hdl32e>;

}  // namespace terracut::velodyne
