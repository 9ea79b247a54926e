// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/packet/sensor_model.hpp"
#include "terracut/calibration.hpp"

/// Converts between the public names of sensors and the models of packets; not installed.
namespace terracut {

/// Converts a decoded model.
[[nodiscard]] constexpr Sensor public_sensor(sensor::SensorModel model) noexcept {
  switch (model) {
    case sensor::SensorModel::kRuby128:
      return Sensor::kRuby128;
    case sensor::SensorModel::kVlp16:
      return Sensor::kVlp16;
    case sensor::SensorModel::kHdl32e:
      return Sensor::kHdl32e;
    case sensor::SensorModel::kVlp32c:
      return Sensor::kVlp32c;
    case sensor::SensorModel::kVls128:
      return Sensor::kVls128;
    default:
      return Sensor::kHdl64e;
  }
}

/// Returns the model of a sensor; an HDL-64E gives the S2 and S3, which stands for all
/// (sensor::is_wanted()).
[[nodiscard]] constexpr sensor::SensorModel model_of(Sensor sensor) noexcept {
  switch (sensor) {
    case Sensor::kRuby128:
      return sensor::SensorModel::kRuby128;
    case Sensor::kVlp16:
      return sensor::SensorModel::kVlp16;
    case Sensor::kHdl32e:
      return sensor::SensorModel::kHdl32e;
    case Sensor::kVlp32c:
      return sensor::SensorModel::kVlp32c;
    case Sensor::kVls128:
      return sensor::SensorModel::kVls128;
    case Sensor::kHdl64e:
      break;
  }
  return sensor::SensorModel::kHdl64e;
}

}  // namespace terracut
