// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware_io/velodyne/velodyne_sensor.hpp"

/// Velodyne's VLS-128, also sold as Alpha Prime (VeloView and velodyne_decoder, from the user
/// manual; docs/reference/sensors.md).
namespace terracut::velodyne {

struct Vls128 {
  static constexpr auto kModel = VelodyneModel::kVls128;
  static constexpr double kMetresPerCount = 0.004;

  /// A firing takes twenty steps: eight lasers fire in each of eight, two steps later in each of
  /// eight more, and two are left. Steps are 2.67 us with firmware 5.1, 2.89 with 5.2, 2.76 in the
  /// capture measured; the beams' directions depend only on their shares.
  static constexpr std::int32_t kStep_ns = 2'763;
  static constexpr int kSteps = 20;
  static constexpr int kLasers = 128, kChannels = kLasers;
  static constexpr PacketLayout kLayout{
      .model = sensor::SensorModel::kVls128,
      .block_ids = {hdl64e::kUpperBlockId, hdl64e::kLowerBlockId, hdl64e::kVls128ThirdId,
                    hdl64e::kVls128FourthId},
      .blocks_per_column = 4,
      .columns_dual = 2,  // the last four blocks are empty
      .column_ns = kSteps * kStep_ns,
      .firing_ns = kSteps * kStep_ns};
  static constexpr int kDefaultColumns = 1809;  ///< 1809.6 firings a frame at 10 Hz.

  static constexpr std::size_t kGroups = 16;
  [[nodiscard]] static constexpr std::size_t group(std::size_t channel) noexcept {
    return channel / 8;
  }
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    const auto step = static_cast<std::int32_t>(group + group / 8 * 2);
    return step * kStep_ns;
  }
};

using Vls128Sensor = VelodyneSensor<Vls128>;

}  // namespace terracut::velodyne
