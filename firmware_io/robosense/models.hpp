// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware_io/packet/robosense_wire.hpp"
#include "firmware_io/robosense/packet_reader.hpp"
#include "firmware_io/table/model_list.hpp"

/// RoboSense's models with 32 lasers, and when each laser fires after a column's first one
/// (table/table_sensor.hpp lists what a model must define; docs/reference/sensors.md).
namespace terracut::robosense {

/// What follows from a model's packet: a column is a block, and every laser fires by itself.
template <sensor::SensorModel kWhich>
struct ModelOf {
  static constexpr auto kModel = kWhich;
  static constexpr const PacketLayout& kLayout = layout_of(kWhich);
  static constexpr table::ColumnPace kPace = pace_of(kLayout);
  static constexpr int kLasers = robosense::kLasers, kChannels = kLasers;
  static constexpr int kDefaultColumns = 1800;  ///< Firings a frame at 10 Hz, to a whole one.
  static constexpr std::size_t kGroups = kChannels;
  [[nodiscard]] static constexpr std::size_t group(std::size_t channel) noexcept { return channel; }
};

/// RS-LiDAR-32. The two lasers that fire one after the other are 16 channels apart.
struct Rs32 : ModelOf<sensor::SensorModel::kRs32> {
  static constexpr double kMetresPerCount = 0.005, kLensAhead_m = 0.03997;
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    const auto number = static_cast<std::int32_t>(group);
    return number % 16 * 2'880 + (number + 1) / 16 * 1'440;
  }
};

/// RS-Helios-5515, -1615 and -1610.
struct Helios : ModelOf<sensor::SensorModel::kHelios> {
  static constexpr double kMetresPerCount = 0.0025, kLensAhead_m = 0.03498;
  [[nodiscard]] static constexpr std::int32_t group_ns(std::size_t group) noexcept {
    constexpr std::array<std::int32_t, 32> kFired_ns{
        0,      1'570,  3'150,  4'720,  6'300,  7'870,  9'450,  11'360, 13'260, 15'170, 17'080,
        18'990, 20'560, 22'140, 23'710, 25'290, 26'530, 27'770, 29'010, 30'250, 31'490, 32'730,
        33'980, 35'220, 36'460, 37'700, 38'940, 40'180, 41'420, 42'670, 43'910, 45'150};
    return kFired_ns[group];
  }
};

/// All models above, for code that folds over models.
using Models = table::ModelList<Rs32, Helios>;
/// A macro for code that needs the preprocessor: expands to DO(Template<model>) for each model
/// above.
#define TERRACUT_FOR_ROBOSENSE_MODELS(DO, Template) \
  DO(Template<terracut::robosense::Rs32>)           \
  DO(Template<terracut::robosense::Helios>)

}  // namespace terracut::robosense
