// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calib/sensor/sensor_model.hpp"
#include "rt/error.hpp"

namespace terracut::velodyne {

/// Where one laser points and begins (docs/reference/sensors.md).
struct VelodyneLaser {
  double elevation_rad = 0;       ///< Positive is up.
  double azimuth_offset_rad = 0;  ///< Added to the head's azimuth; clockwise.
  double vert_offset_m = 0;       ///< Height of the beam's start above the sensor's origin.

  bool operator==(const VelodyneLaser&) const = default;
};

/// The directions of a Velodyne with a factory table: its lasers by their number on the wire, which
/// is NOT in order of elevation.
struct VelodyneCalibration {
  sensor::SensorModel model{};
  std::vector<VelodyneLaser> lasers;  ///< One for each laser of the model.
  std::string origin;                 ///< For logs: "factory table of the VLP-16".
};

/// The table in the maker's manual of a model that sensor::has_factory_table(); else without
/// lasers.
[[nodiscard]] VelodyneCalibration factory_table(sensor::SensorModel model);

/// Errors: kInvalidArgument if the number of lasers is not the model's or an angle is not finite.
[[nodiscard]] Status validate(const VelodyneCalibration& calibration);

/// Returns a 64-bit hash of the model and all values (not of the origin), rounded to thousandths of
/// a degree and tenths of a millimetre.
[[nodiscard]] std::uint64_t fingerprint(const VelodyneCalibration& calibration);

/// Returns the row of every laser in the range image: row 0 is the lowest elevation.
[[nodiscard]] std::vector<int> rows_by_elevation(const VelodyneCalibration& calibration);

}  // namespace terracut::velodyne
