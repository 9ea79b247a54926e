// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/table/model_list.hpp"
#include "firmware_io/velodyne/packet_layout.hpp"

/// The models of Velodyne's family, and when each of their lasers fires (velodyne_sensor.hpp lists
/// what a model must define).
namespace terracut::velodyne {

/// Velodyne's VLP-16, also sold as Puck and Puck LITE (VLP-16 user manual, packet structure and
/// timing; docs/reference/sensors.md).
struct Vlp16 {
  static constexpr auto kModel = sensor::SensorModel::kVlp16;
  static constexpr double kMetresPerCount = 0.002;

  /// The time from one firing of all lasers to the next, and from one laser to the next. Lasers
  /// fire one by one.
  static constexpr std::int32_t kFiring_ns = 55'296, kLaser_ns = 2'304;
  /// Each block holds two firings of all lasers, and the azimuth of the first.
  static constexpr int kLasers = 16, kChannels = 2 * kLasers;
  static constexpr PacketLayout kLayout{.model = kModel,
                                        .block_ids = {hdl64e::kUpperBlockId},
                                        .pace = {2 * kFiring_ns, 12, 6},
                                        .firing_ns = kFiring_ns};
  static constexpr table::ColumnPace kPace = kLayout.pace;
  static constexpr int kDefaultColumns = 1808;  ///< 1808.4 firings a frame at 10 Hz.

  static constexpr std::size_t kGroups = kChannels;
  [[nodiscard]] static constexpr std::size_t group(std::size_t channel) noexcept { return channel; }
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    const auto channel = static_cast<std::int32_t>(group);
    return channel / kLasers * kFiring_ns + channel % kLasers * kLaser_ns;
  }
};

/// Velodyne's HDL-32E (HDL-32E application note, packet structure and timing;
/// docs/reference/sensors.md).
struct Hdl32e {
  static constexpr auto kModel = sensor::SensorModel::kHdl32e;
  static constexpr double kMetresPerCount = 0.002;

  /// The time from one laser to the next; lasers fire one by one.
  static constexpr std::int32_t kLaser_ns = 1'152;
  static constexpr int kLasers = 32, kChannels = kLasers;
  static constexpr PacketLayout kLayout{.model = kModel,
                                        .block_ids = {hdl64e::kUpperBlockId},
                                        .pace = {46'080, 12, 6},
                                        .firing_ns = 46'080};
  static constexpr table::ColumnPace kPace = kLayout.pace;
  static constexpr int kDefaultColumns = 2170;  ///< 2170.1 firings a frame at 10 Hz.

  static constexpr std::size_t kGroups = kChannels;
  [[nodiscard]] static constexpr std::size_t group(std::size_t channel) noexcept { return channel; }
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    return static_cast<std::int32_t>(group) * kLaser_ns;
  }
};

/// Velodyne's VLP-32C, also sold as Ultra Puck (VLP-32C user manual, packet structure and timing;
/// docs/reference/sensors.md).
struct Vlp32c {
  static constexpr auto kModel = sensor::SensorModel::kVlp32c;
  static constexpr double kMetresPerCount = 0.004;

  /// The time from one pair of lasers to the next. The two lasers of a pair fire together.
  static constexpr std::int32_t kPair_ns = 2'304;
  static constexpr int kLasers = 32, kChannels = kLasers;
  static constexpr PacketLayout kLayout{.model = kModel,
                                        .block_ids = {hdl64e::kUpperBlockId},
                                        .pace = {55'296, 12, 6},
                                        .firing_ns = 55'296};
  static constexpr table::ColumnPace kPace = kLayout.pace;
  static constexpr int kDefaultColumns = 1808;  ///< 1808.4 firings a frame at 10 Hz.

  static constexpr std::size_t kGroups = kChannels / 2;
  [[nodiscard]] static constexpr std::size_t group(std::size_t channel) noexcept {
    return channel / 2;
  }
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    return static_cast<std::int32_t>(group) * kPair_ns;
  }
};

/// Velodyne's VLS-128, also sold as Alpha Prime (VeloView and velodyne_decoder, from the user
/// manual; docs/reference/sensors.md).
struct Vls128 {
  static constexpr auto kModel = sensor::SensorModel::kVls128;
  static constexpr double kMetresPerCount = 0.004;

  /// A firing of all lasers takes twenty steps. Eight lasers fire in each of the first eight steps;
  /// after a pause of two steps, eight lasers fire in each of eight more steps; then two steps
  /// pass. A step takes 2.67 us with firmware 5.1, 2.89 with 5.2, and 2.76 in the capture at hand;
  /// the beams' directions depend only on the shares of the steps.
  static constexpr std::int32_t kStep_ns = 2'763;
  static constexpr int kSteps = 20;
  static constexpr int kLasers = 128, kChannels = kLasers;
  static constexpr PacketLayout kLayout{
      .model = kModel,
      .block_ids = {hdl64e::kUpperBlockId, hdl64e::kLowerBlockId, hdl64e::kVls128ThirdId,
                    hdl64e::kVls128FourthId},
      .blocks_per_column = 4,
      .columns_dual = 2,  // the last four blocks are empty
      .pace = {kSteps * kStep_ns, 3, 1},
      .firing_ns = kSteps * kStep_ns};
  static constexpr table::ColumnPace kPace = kLayout.pace;
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

/// All models above, for code that folds over models.
using Models = table::ModelList<Vlp16, Hdl32e, Vlp32c, Vls128>;
/// A macro for code that needs the preprocessor: expands to DO(Template<model>) for each model
/// above.
#define TERRACUT_FOR_VELODYNE_MODELS(DO, Template) \
  DO(Template<terracut::velodyne::Vlp16>)          \
  DO(Template<terracut::velodyne::Hdl32e>)         \
  DO(Template<terracut::velodyne::Vlp32c>)         \
  DO(Template<terracut::velodyne::Vls128>)

/// Returns the packet layout of `model`; null if the model is none of the above.
[[nodiscard]] constexpr const PacketLayout* layout_of(sensor::SensorModel model) noexcept {
  const auto* const found = std::ranges::find(Models::kLayouts, model, &PacketLayout::model);
  return found == Models::kLayouts.end() ? nullptr : found;
}

}  // namespace terracut::velodyne
