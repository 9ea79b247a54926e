// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "calib/beams/beam_table.hpp"
#include "calib/ouster/packet_format.hpp"
#include "calib/sensor/sensor_model.hpp"
#include "rt/error.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ouster {

/// What an Ouster unit says of itself: where its beams begin and point, and how its packets are
/// made. With d = the range less `beam_origin_m`, t = the head's azimuth, h and v = the beam's
/// azimuth offset and elevation, o = its vertical offset, a return lies in the frame of the
/// rotating lidar, whose x axis points to the unit's connector, at
///
///   x =   d cos v cos(t + h) + ahead_m cos t
///   y = -(d cos v sin(t + h) + ahead_m sin t)
///   z =   d sin v + o
struct OusterCalibration {
  PacketFormat format;
  int columns_per_frame = 1024;
  double rate_hz = 10;                   ///< Frames a second.
  std::array<int, 2> window{0, 1023};    ///< First and last column that is sent.
  std::vector<beams::TableBeam> lasers;  ///< One for each row, in the order of the wire.
  double ahead_m = 0;                    ///< How far beams begin ahead of the axis of rotation.
  double beam_origin_m = 0;  ///< Ranges count from this far behind the beams' beginning.
  /// Row-major 3x4 [R t], metres: from the lidar's frame to the unit's (x ahead, y left, z up,
  /// origin in its base).
  std::array<double, 12> T_sensor_lidar{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  std::string product;  ///< "OS-1-128"; empty where the unit does not say.
  std::string origin;   ///< Where the table comes from, for logs.
};

/// Returns a table for use without a unit: that of an OS1 with evenly spaced beams. `model` is one
/// of Ouster's.
[[nodiscard]] OusterCalibration nominal_ouster(sensor::SensorModel model);

/// Returns the model with so many rows; kUnknown if there is none.
[[nodiscard]] sensor::SensorModel model_of_rows(int rows) noexcept TERRACUT_NONBLOCKING;

/// Returns the rows of one of Ouster's models.
[[nodiscard]] int rows_of(sensor::SensorModel model) noexcept TERRACUT_NONBLOCKING;

/// Fails with kMalformed if a value is not finite or outside what a unit can have: as many beams as
/// rows, elevations within 60 and azimuth offsets within 20 degrees, beams that begin within 0.2 m
/// of the axis, columns that a mode has, a window within them, and a transform that turns the lidar
/// about its vertical axis only. kUnsupported for another number of rows or columns in a packet.
[[nodiscard]] Status validate(const OusterCalibration& calibration);

/// Returns a 64-bit hash of all that decides on coordinates (not of `product` and `origin`),
/// rounded to thousandths of a degree and of a millimetre.
[[nodiscard]] std::uint64_t fingerprint(const OusterCalibration& calibration);

/// Returns the range image row of each laser: row 0 has the lowest elevation.
[[nodiscard]] std::vector<int> rows_by_elevation(const OusterCalibration& calibration);

}  // namespace terracut::ouster
