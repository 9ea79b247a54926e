// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "calib/velodyne/velodyne_calibration.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::sensor {

/// What sent a UDP payload, as far as the payload itself tells (docs/reference/sensors.md).
enum class SensorModel : std::uint8_t {
  kUnknown,
  kHdl64e,    ///< HDL-64E S2, S2.1 or S3: decoded.
  kHdl64eS1,  ///< The first HDL-64E, other block order, no clock: decoded.
  kHdl32e,    ///< Decoded.
  kVlp16,     ///< Also sold as Puck LITE: decoded.
  kVlp16HiRes,
  kVlp32c,              ///< Decoded.
  kVls128,              ///< Alpha Prime: decoded.
  kOtherVelodyne,       ///< Velodyne's data packet with a product number not known here.
  kVelodynePosition,    ///< 512 bytes with NMEA text, of the models below the HDL-64E.
  kRuby128,             ///< RS-Ruby128: decoded.
  kRubyPlus,            ///< The same layout, other angles and firing times; told by type bytes.
  kRubyLite,            ///< Ruby Lite / Ruby 80: four blocks of 80 channels.
  kOtherRoboSense,      ///< RoboSense's data packet of another model.
  kRoboSenseDeviceInfo  ///< DIFOP, sent about once a second.
};

/// Those that are decoded.
inline constexpr std::array kDecodedModels{
    SensorModel::kHdl64e, SensorModel::kHdl64eS1, SensorModel::kRuby128, SensorModel::kVlp16,
    SensorModel::kHdl32e, SensorModel::kVlp32c,   SensorModel::kVls128};
[[nodiscard]] constexpr bool is_decoded(SensorModel model) noexcept {
  return std::ranges::find(kDecodedModels, model) != kDecodedModels.end();
}

/// The model of the family whose table is built in; nothing for others.
[[nodiscard]] constexpr std::optional<velodyne::VelodyneModel> velodyne_model_of(
    SensorModel model) noexcept {
  switch (model) {
    case SensorModel::kVlp16:
      return velodyne::VelodyneModel::kVlp16;
    case SensorModel::kHdl32e:
      return velodyne::VelodyneModel::kHdl32e;
    case SensorModel::kVlp32c:
      return velodyne::VelodyneModel::kVlp32c;
    case SensorModel::kVls128:
      return velodyne::VelodyneModel::kVls128;
    default:
      return std::nullopt;
  }
}

/// The number in a data packet of a Velodyne with a built-in table; 0 for others.
[[nodiscard]] std::uint8_t product_number(SensorModel model) noexcept;

/// A user who asked for this model, or for none, means that one, too: an HDL-64E of any generation.
[[nodiscard]] constexpr bool is_wanted(std::optional<SensorModel> asked,
                                       SensorModel model) noexcept {
  return !asked || *asked == model ||
         (*asked == SensorModel::kHdl64e && model == SensorModel::kHdl64eS1);
}

/// The name people know it by, "Velodyne HDL-64E (S2/S3)".
[[nodiscard]] std::string_view to_string(SensorModel model) noexcept;

/// Judged by size, magic numbers and block structure, never by port; never reads outside `payload`.
/// On Velodyne's 1206 bytes the product number is believed only when the block order is not that of
/// an HDL-64E, whose last bytes are its status stream. Allocates nothing.
[[nodiscard]] SensorModel recognise_sensor(std::span<const std::uint8_t> payload) noexcept
    TERRACUT_NONBLOCKING;

/// The same where somebody knows that the sensor is a `named` one: so are Velodyne's data packets
/// with a product number not known here, which simulators, old firmware and the VLP-32A send, if
/// their blocks are such a model's.
[[nodiscard]] SensorModel recognise_sensor_as(std::optional<SensorModel> named,
                                              std::span<const std::uint8_t> payload) noexcept
    TERRACUT_NONBLOCKING;

/// What else the payload says of the model, for people: product number and return mode of a
/// Velodyne, type bytes of a RoboSense and what documents say they mean. Empty when nothing.
[[nodiscard]] std::string describe_sensor_hints(std::span<const std::uint8_t> payload);

}  // namespace terracut::sensor
