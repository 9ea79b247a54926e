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

/// The kind of a UDP payload, as far as the payload itself tells (docs/reference/sensors.md).
enum class SensorModel : std::uint8_t {
  kUnknown,
  kHdl64e,    ///< HDL-64E S2, S2.1 or S3: decoded.
  kHdl64eS1,  ///< The first HDL-64E: other block order, no clock. Decoded.
  kHdl32e,    ///< Decoded.
  kVlp16,     ///< Also sold as Puck LITE: decoded.
  kVlp16HiRes,
  kVlp32c,              ///< Decoded.
  kVls128,              ///< Alpha Prime: decoded.
  kOtherVelodyne,       ///< Velodyne's data packet with an unknown product number.
  kVelodynePosition,    ///< 512 bytes with NMEA text, of the models below the HDL-64E.
  kRuby128,             ///< RS-Ruby128: decoded.
  kRubyPlus,            ///< The same layout, other angles and firing times; told by type bytes.
  kRubyLite,            ///< Ruby Lite / Ruby 80: four blocks of 80 channels.
  kOtherRoboSense,      ///< RoboSense's data packet of another model.
  kRoboSenseDeviceInfo  ///< DIFOP, sent about once a second.
};

/// The models that are decoded.
inline constexpr std::array kDecodedModels{
    SensorModel::kHdl64e, SensorModel::kHdl64eS1, SensorModel::kRuby128, SensorModel::kVlp16,
    SensorModel::kHdl32e, SensorModel::kVlp32c,   SensorModel::kVls128};
[[nodiscard]] constexpr bool is_decoded(SensorModel model) noexcept {
  return std::ranges::find(kDecodedModels, model) != kDecodedModels.end();
}

/// Returns the Velodyne model whose table is built in; nothing for other models.
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

/// Returns the number in a data packet of a Velodyne with a built-in table; 0 for others.
[[nodiscard]] std::uint8_t product_number(SensorModel model) noexcept;

/// True if a user who asked for `asked`, or for no model, accepts this one: an HDL-64E of any
/// generation counts as HDL-64E.
[[nodiscard]] constexpr bool is_wanted(std::optional<SensorModel> asked,
                                       SensorModel model) noexcept {
  return !asked || *asked == model ||
         (*asked == SensorModel::kHdl64e && model == SensorModel::kHdl64eS1);
}

/// Returns the model's full name, "Velodyne HDL-64E (S2/S3)".
[[nodiscard]] std::string_view to_string(SensorModel model) noexcept;

/// Recognises a payload by size, magic numbers and block structure, never by port; reads nothing
/// outside `payload`. The product number in Velodyne's 1206 bytes is used only if the block order
/// is not an HDL-64E's, whose last bytes are its status stream. Allocates nothing.
[[nodiscard]] SensorModel recognise_sensor(std::span<const std::uint8_t> payload) noexcept
    TERRACUT_NONBLOCKING;

/// Recognises a payload if the sensor is said to be a `named` one. That model then also covers
/// Velodyne's data packets with an unknown product number, which simulators, old firmware and the
/// VLP-32A send, if their blocks are the model's.
[[nodiscard]] SensorModel recognise_sensor_as(std::optional<SensorModel> named,
                                              std::span<const std::uint8_t> payload) noexcept
    TERRACUT_NONBLOCKING;

/// Describes further facts in the payload for people: product number and return mode of a Velodyne,
/// type bytes of a RoboSense and their documented meaning. Empty if there are none.
[[nodiscard]] std::string describe_sensor_hints(std::span<const std::uint8_t> payload);

}  // namespace terracut::sensor
