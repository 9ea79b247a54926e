// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calib/sensor/sensor_model.hpp"
#include "rt/error.hpp"

namespace terracut::beams {

/// The start and direction of one laser's beam (docs/reference/sensors.md).
struct TableBeam {
  double elevation_rad = 0;       ///< Elevation of the beam; positive is up.
  double azimuth_offset_rad = 0;  ///< Azimuth of the beam from the head's, clockwise.
  double vert_offset_m = 0;       ///< Height of the beam's start above the sensor's origin.

  bool operator==(const TableBeam&) const = default;
};

/// The directions of a sensor whose beams are straight: a Velodyne with a factory table, or a
/// Hesai. Lasers stand by their number on the wire, which is NOT in order of elevation.
struct BeamTable {
  sensor::SensorModel model{};
  std::vector<TableBeam> lasers;  ///< One for each laser of the model.
  std::string origin;  ///< Where the table comes from, for logs: "factory table of the VLP-16".
};

/// Returns the table in the maker's manual if sensor::has_built_in_table(model); else a table
/// without lasers.
[[nodiscard]] BeamTable built_in_table(sensor::SensorModel model);

/// Fails with kInvalidArgument if the number of lasers is not the model's or an angle is not
/// finite.
[[nodiscard]] Status validate(const BeamTable& calibration);

/// Returns a 64-bit hash of the model and all values (not of `origin`), rounded to thousandths of a
/// degree and tenths of a millimetre.
[[nodiscard]] std::uint64_t fingerprint(const BeamTable& calibration);

/// Returns the range image row of each laser: row 0 has the lowest elevation.
[[nodiscard]] std::vector<int> rows_by_elevation(const BeamTable& calibration);

}  // namespace terracut::beams
