// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "calib/sensor/factory_lasers.hpp"
#include "terracut/sensor.hpp"

namespace terracut::sensor {

/// What sent a UDP payload, as far as the payload itself tells (docs/reference/sensors.md). What is
/// known of each: kSensorTable.
enum class SensorModel : std::uint8_t {
  kUnknown,
  kHdl64e,    ///< HDL-64E S2, S2.1 or S3.
  kHdl64eS1,  ///< The first HDL-64E: another block order, no clock.
  kHdl32e,
  kVlp16,  ///< Also sold as Puck LITE.
  kVlp16HiRes,
  kVlp32c,
  kVls128,              ///< Alpha Prime.
  kOtherVelodyne,       ///< Velodyne's data packet with a product number not known here.
  kVelodynePosition,    ///< 512 bytes with NMEA text, of the models below the HDL-64E.
  kRuby128,             ///< RS-Ruby128.
  kRubyPlus,            ///< The same layout, other angles and firing times; told by type bytes.
  kRubyLite,            ///< Ruby Lite / Ruby 80: four blocks of 80 channels.
  kOtherRoboSense,      ///< RoboSense's data packet of another model.
  kRoboSenseDeviceInfo  ///< DIFOP, sent about once a second.
};

/// What is known of a model. What only its packets' decoder needs, its trait knows
/// (firmware_io/velodyne/models.hpp).
struct SensorRow {
  SensorModel model{};
  std::string_view name;            ///< For people: "Velodyne VLP-16".
  std::optional<Sensor> sensor{};   ///< What it is decoded as; none: it is not decoded.
  std::string_view word{};          ///< Of --sensor; empty: it has none of its own.
  std::uint8_t product_number = 0;  ///< Last byte of a Velodyne's data packet; 0: it has none.
  std::uint8_t stream_number = 0;   ///< In the labelled stream; never changes. 0: not decoded.
  std::span<const FactoryLaser> lasers{};  ///< Of every unit; empty: each has a table of its own.
  /// In dual return. Of a model without its own figure that of an RS-Ruby128, which is above it.
  double most_packets_per_second = 12'001;
};

/// In the order in which decoded models are offered to people; kUnknown is the last one.
inline constexpr std::array kSensorTable{
    SensorRow{.model = SensorModel::kHdl64e,
              .name = "Velodyne HDL-64E (S2/S3)",
              .sensor = Sensor::kHdl64e,
              .word = "hdl64e",
              .stream_number = 1},
    SensorRow{.model = SensorModel::kHdl64eS1,
              .name = "Velodyne HDL-64E S1",
              .sensor = Sensor::kHdl64e,
              .stream_number = 1},
    SensorRow{.model = SensorModel::kRuby128,
              .name = "RoboSense RS-Ruby128",
              .sensor = Sensor::kRuby128,
              .word = "ruby128",
              .stream_number = 2},
    SensorRow{.model = SensorModel::kVlp16,
              .name = "Velodyne VLP-16",
              .sensor = Sensor::kVlp16,
              .word = "vlp16",
              .product_number = 0x22,
              .stream_number = 3,
              .lasers = kVlp16Lasers},
    SensorRow{.model = SensorModel::kHdl32e,
              .name = "Velodyne HDL-32E",
              .sensor = Sensor::kHdl32e,
              .word = "hdl32e",
              .product_number = 0x21,
              .stream_number = 4,
              .lasers = kHdl32eLasers},
    SensorRow{.model = SensorModel::kVlp32c,
              .name = "Velodyne VLP-32C",
              .sensor = Sensor::kVlp32c,
              .word = "vlp32c",
              .product_number = 0x28,
              .stream_number = 5,
              .lasers = kVlp32cLasers},
    SensorRow{.model = SensorModel::kVls128,
              .name = "Velodyne VLS-128",
              .sensor = Sensor::kVls128,
              .word = "vls128",
              .product_number = 0xA1,
              .stream_number = 6,
              .lasers = kVls128Lasers,
              .most_packets_per_second = 18'750},  // a packet a firing
    SensorRow{.model = SensorModel::kVlp16HiRes,
              .name = "Velodyne VLP-16 Hi-Res",
              .product_number = 0x24},
    SensorRow{.model = SensorModel::kOtherVelodyne, .name = "other Velodyne"},
    SensorRow{.model = SensorModel::kVelodynePosition, .name = "Velodyne position packets"},
    SensorRow{.model = SensorModel::kRubyPlus, .name = "RoboSense Ruby Plus"},
    SensorRow{.model = SensorModel::kRubyLite, .name = "RoboSense Ruby Lite (80)"},
    SensorRow{.model = SensorModel::kOtherRoboSense, .name = "other RoboSense"},
    SensorRow{.model = SensorModel::kRoboSenseDeviceInfo, .name = "RoboSense device info (DIFOP)"},
    SensorRow{.model = SensorModel::kUnknown, .name = "unknown"}};

[[nodiscard]] constexpr const SensorRow& row_of(SensorModel model) noexcept {
  const auto* const found = std::ranges::find(kSensorTable, model, &SensorRow::model);
  return found == kSensorTable.end() ? kSensorTable.back() : *found;
}
[[nodiscard]] constexpr std::string_view to_string(SensorModel model) noexcept {
  return row_of(model).name;
}
[[nodiscard]] constexpr bool is_decoded(SensorModel model) noexcept {
  return row_of(model).sensor.has_value();
}
/// Of a decoded model.
[[nodiscard]] constexpr Sensor sensor_of(SensorModel model) noexcept {
  return row_of(model).sensor.value_or(Sensor::kHdl64e);
}
/// All units of it have one table, which is built in.
[[nodiscard]] constexpr bool has_factory_table(SensorModel model) noexcept {
  return !row_of(model).lasers.empty();
}
/// Of an HDL-64E that of the S2 and S3, which stands for all.
[[nodiscard]] constexpr SensorModel model_of(Sensor sensor) noexcept {
  return std::ranges::find(kSensorTable, std::optional(sensor), &SensorRow::sensor)->model;
}

/// A user who asked for this model, or for none, means that one, too: an HDL-64E of any generation.
[[nodiscard]] constexpr bool is_wanted(std::optional<SensorModel> asked,
                                       SensorModel model) noexcept {
  const std::optional<Sensor> sensor = row_of(model).sensor;
  return !asked || *asked == model || (sensor && *asked == model_of(*sensor));
}

inline constexpr auto kDecodedModels = [] {
  std::array<SensorModel, std::ranges::count_if(kSensorTable, is_decoded, &SensorRow::model)>
      models{};
  std::size_t count = 0;
  for (const SensorRow& row : kSensorTable) {
    if (row.sensor) models[count++] = row.model;
  }
  return models;
}();

}  // namespace terracut::sensor
