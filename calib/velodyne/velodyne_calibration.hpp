// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rt/error.hpp"

namespace terracut::velodyne {

/// Velodyne's models whose units all share the model's directions, to a few hundredths of a degree.
/// The HDL-64E is not among them: each of its units has its own table.
enum class VelodyneModel : std::uint8_t { kVlp16, kHdl32e, kVlp32c, kVls128 };
inline constexpr int kVelodyneModels = 4;
/// Returns "VLP-16" and the like.
[[nodiscard]] std::string_view to_string(VelodyneModel model) noexcept;

/// One laser's direction and starting point (docs/reference/sensors.md).
struct VelodyneLaser {
  double elevation_rad = 0;       ///< Positive is up.
  double azimuth_offset_rad = 0;  ///< Added to the head's azimuth; clockwise.
  double vert_offset_m = 0;       ///< Height of the beam's start above the sensor's origin.

  bool operator==(const VelodyneLaser&) const = default;
};

/// The directions of one sensor: its lasers by their number on the wire, which is NOT in order of
/// elevation.
struct VelodyneCalibration {
  VelodyneModel model{};
  std::vector<VelodyneLaser> lasers;  ///< As many as the model has lasers.
  std::string origin;                 ///< For logs: "factory table of the VLP-16".
};

/// Returns the table in the maker's manual of the model.
[[nodiscard]] VelodyneCalibration factory_table(VelodyneModel model);

/// kInvalidArgument if the number of lasers is not the model's or an angle is not finite.
[[nodiscard]] Status validate(const VelodyneCalibration& calibration);

/// Returns a 64-bit hash of the model and all values (not of the origin), rounded to thousandths of
/// a degree and tenths of a millimetre.
[[nodiscard]] std::uint64_t fingerprint(const VelodyneCalibration& calibration);

/// Returns the row of every laser in the range image: row 0 is the lowest elevation.
[[nodiscard]] std::vector<int> rows_by_elevation(const VelodyneCalibration& calibration);

}  // namespace terracut::velodyne
