// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calib/sensor/sensor_model.hpp"
#include "rt/error.hpp"

namespace terracut::velodyne {

/// The start and direction of one laser's beam (docs/reference/sensors.md).
struct VelodyneLaser {
  double elevation_rad = 0;       ///< Elevation of the beam; positive is up.
  double azimuth_offset_rad = 0;  ///< Azimuth of the beam from the head's, clockwise.
  double vert_offset_m = 0;       ///< Height of the beam's start above the sensor's origin.

  bool operator==(const VelodyneLaser&) const = default;
};

/// The directions of a Velodyne with a factory table: its lasers by their number on the wire, which
/// is NOT in order of elevation.
struct VelodyneCalibration {
  sensor::SensorModel model{};
  std::vector<VelodyneLaser> lasers;  ///< One for each laser of the model.
  std::string origin;  ///< Where the table comes from, for logs: "factory table of the VLP-16".
};

/// Returns the table in the maker's manual if sensor::has_factory_table(model); else a calibration
/// without lasers.
[[nodiscard]] VelodyneCalibration factory_table(sensor::SensorModel model);

/// Fails with kInvalidArgument if the number of lasers is not the model's or an angle is not
/// finite.
[[nodiscard]] Status validate(const VelodyneCalibration& calibration);

/// Returns a 64-bit hash of the model and all values (not of `origin`), rounded to thousandths of a
/// degree and tenths of a millimetre.
[[nodiscard]] std::uint64_t fingerprint(const VelodyneCalibration& calibration);

/// Returns the range image row of each laser: row 0 has the lowest elevation.
[[nodiscard]] std::vector<int> rows_by_elevation(const VelodyneCalibration& calibration);

}  // namespace terracut::velodyne
