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
#include "calib/sensor/hesai_lasers.hpp"
#include "calib/sensor/robosense_lasers.hpp"
#include "terracut/sensor.hpp"

namespace terracut::sensor {

/// Which sensor sent a UDP payload, as far as the payload tells (docs/reference/sensors.md).
/// kSensorTable holds what is known of each model.
enum class SensorModel : std::uint8_t {
  kUnknown,
  kHdl64e,    ///< HDL-64E S2, S2.1 or S3.
  kHdl64eS1,  ///< The first HDL-64E: another block order, no clock.
  kHdl32e,
  kVlp16,  ///< Also sold as Puck LITE.
  kVlp16HiRes,
  kVlp32c,
  kVls128,         ///< Alpha Prime.
  kOtherVelodyne,  ///< A Velodyne data packet with a product number not known here.
  /// Not a data packet: 512 bytes with NMEA text, from models below the HDL-64E.
  kVelodynePosition,
  kRuby128,              ///< RS-Ruby128.
  kRs32,                 ///< RS-LiDAR-32.
  kHelios,               ///< An RS-Helios with 32 lasers: 5515, 1615 or 1610.
  kRubyPlus,             ///< Has the RS-Ruby128's layout, but other angles and firing times.
  kRubyLite,             ///< Ruby Lite / Ruby 80: packets have four blocks of 80 channels.
  kOtherRoboSense,       ///< A RoboSense data packet of another model.
  kRoboSenseDeviceInfo,  ///< A DIFOP packet about the sensor, sent about once a second.
  kPandar40p,
  kPandar64,
  kPandarQt64,
  kPandarQt128,
  kPandarXt16,
  kPandarXt32,
  kPandarXt32m,
  kOt128,
  kPandar128,
  kOuster32,  ///< OS0, OS1 or OS2; which of them, only the unit's metadata says.
  kOuster64,
  kOuster128
};

/// What is known of a model. Facts that only the model's packet decoder needs are in its trait
/// (firmware_io/velodyne/models.hpp).
struct SensorRow {
  SensorModel model{};
  std::string_view name;           ///< The model's name for people: "Velodyne VLP-16".
  std::optional<Sensor> sensor{};  ///< The sensor that packets are decoded as; empty: not decoded.
  std::string_view word{};  ///< The word for --sensor; empty: the model has no word of its own.
  std::uint8_t product_number = 0;  ///< Last byte of a Velodyne's data packet; 0: no such number.
  /// The model's number in the labelled stream; never changes. 0: not decoded.
  std::uint8_t stream_number = 0;
  /// The lasers of every unit, or nominal ones; empty: there is no table but the unit's own.
  std::span<const FactoryLaser> lasers{};
  /// True if `lasers` are nominal: each unit has a table of its own.
  bool has_unit_tables = false;
  /// Highest packet rate, in dual return. The default is an RS-Ruby128's, which is above that of
  /// models without a figure of their own.
  double most_packets_per_second = 12'001;
  /// Payload bytes of the longest data packet, for the recorder's memory and receive buffers; the
  /// default is an RS-Ruby128's.
  std::size_t longest_packet_bytes = 1'248;
};

/// Decoded models stand in the order in which people are offered them; kUnknown is the last row.
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
    SensorRow{.model = SensorModel::kRs32,
              .name = "RoboSense RS-LiDAR-32",
              .sensor = Sensor::kRs32,
              .word = "rs32",
              .stream_number = 19,
              .lasers = kRs32Lasers,
              .has_unit_tables = true},
    SensorRow{.model = SensorModel::kHelios,
              .name = "RoboSense RS-Helios",
              .sensor = Sensor::kHelios,
              .word = "helios",
              .stream_number = 20,
              .lasers = kHeliosLasers,
              .has_unit_tables = true},
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
              .most_packets_per_second = 18'750},  // each packet holds one firing
    SensorRow{.model = SensorModel::kPandar40p,
              .name = "Hesai Pandar40P",
              .sensor = Sensor::kPandar40p,
              .word = "pandar40p",
              .stream_number = 7,
              .lasers = kPandar40pLasers,
              .has_unit_tables = true},
    SensorRow{.model = SensorModel::kPandar64,
              .name = "Hesai Pandar64",
              .sensor = Sensor::kPandar64,
              .word = "pandar64",
              .stream_number = 8,
              .lasers = kPandar64Lasers,
              .has_unit_tables = true},
    SensorRow{.model = SensorModel::kPandarQt64,
              .name = "Hesai PandarQT64",
              .sensor = Sensor::kPandarQt64,
              .word = "pandarqt64",
              .stream_number = 9,
              .lasers = kPandarQt64Lasers,
              .has_unit_tables = true},
    SensorRow{.model = SensorModel::kPandarQt128,
              .name = "Hesai PandarQT128",
              .sensor = Sensor::kPandarQt128,
              .word = "pandarqt128",
              .stream_number = 10,
              .lasers = kPandarQt128Lasers,
              .has_unit_tables = true},
    SensorRow{.model = SensorModel::kPandarXt16,
              .name = "Hesai PandarXT-16",
              .sensor = Sensor::kPandarXt16,
              .word = "pandarxt16",
              .stream_number = 11,
              .lasers = kPandarXt16Lasers,
              .has_unit_tables = true},
    SensorRow{.model = SensorModel::kPandarXt32,
              .name = "Hesai PandarXT-32",
              .sensor = Sensor::kPandarXt32,
              .word = "pandarxt32",
              .stream_number = 12,
              .lasers = kPandarXt32Lasers,
              .has_unit_tables = true},
    SensorRow{.model = SensorModel::kPandarXt32m,
              .name = "Hesai PandarXT-32M",
              .sensor = Sensor::kPandarXt32m,
              .word = "pandarxt32m",
              .stream_number = 13,
              .lasers = kPandarXt32mLasers,
              .has_unit_tables = true},
    SensorRow{.model = SensorModel::kOt128,
              .name = "Hesai OT128",
              .sensor = Sensor::kOt128,
              .word = "ot128",
              .stream_number = 17,
              .lasers = kOt128Lasers,
              .has_unit_tables = true,
              .most_packets_per_second = 36'001,  // each packet holds one firing
              .longest_packet_bytes = 893},
    SensorRow{.model = SensorModel::kPandar128,
              .name = "Hesai Pandar128",
              .sensor = Sensor::kPandar128,
              .word = "pandar128",
              .stream_number = 18,
              .lasers = kPandar128Lasers,
              .has_unit_tables = true,
              .most_packets_per_second = 36'001,
              .longest_packet_bytes = 893},
    SensorRow{.model = SensorModel::kOuster32,
              .name = "32-row Ouster",
              .sensor = Sensor::kOuster32,
              .word = "ouster32",
              .stream_number = 14,
              .most_packets_per_second = 1'281,
              .longest_packet_bytes = 8'448},
    SensorRow{.model = SensorModel::kOuster64,
              .name = "64-row Ouster",
              .sensor = Sensor::kOuster64,
              .word = "ouster64",
              .stream_number = 15,
              .most_packets_per_second = 1'281,
              .longest_packet_bytes = 16'640},
    SensorRow{.model = SensorModel::kOuster128,
              .name = "128-row Ouster",
              .sensor = Sensor::kOuster128,
              .word = "ouster128",
              .stream_number = 16,
              .most_packets_per_second = 1'281,
              .longest_packet_bytes = 33'024},
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
/// Returns the sensor that a decoded model is decoded as.
[[nodiscard]] constexpr Sensor sensor_of(SensorModel model) noexcept {
  return row_of(model).sensor.value_or(Sensor::kHdl64e);
}
/// True if a table of `model` is built in: that of all its units, or a nominal one.
[[nodiscard]] constexpr bool has_built_in_table(SensorModel model) noexcept {
  return !row_of(model).lasers.empty();
}
/// True if all units of `model` have one table, which is built in.
[[nodiscard]] constexpr bool has_factory_table(SensorModel model) noexcept {
  return has_built_in_table(model) && !row_of(model).has_unit_tables;
}
/// True for a decoded RoboSense, whose units send their tables in DIFOP packets.
[[nodiscard]] constexpr bool is_robosense(SensorModel model) noexcept {
  return model >= SensorModel::kRuby128 && model <= SensorModel::kHelios;
}
/// True for a Hesai, whose units have tables of their own in files only.
[[nodiscard]] constexpr bool is_hesai(SensorModel model) noexcept {
  return model >= SensorModel::kPandar40p && model <= SensorModel::kPandar128;
}
/// True for an Ouster, whose packets need the unit's metadata to be decoded.
[[nodiscard]] constexpr bool is_ouster(SensorModel model) noexcept {
  return model >= SensorModel::kOuster32 && model <= SensorModel::kOuster128;
}
/// Returns the model of a sensor. For an HDL-64E of any generation this is kHdl64e.
[[nodiscard]] constexpr SensorModel model_of(Sensor sensor) noexcept {
  return std::ranges::find(kSensorTable, std::optional(sensor), &SensorRow::sensor)->model;
}

/// True if `model` matches `asked`: nothing was asked for, both are the same, or both are
/// generations of the HDL-64E.
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
