// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "terracut/error.hpp"
#include "terracut/sensor.hpp"

namespace terracut {

/// How the sensor stands above the ground. The vehicle frame has x ahead, y to the left, z up, and
/// its origin on the ground below the sensor.
struct Mount {
  double height_m = 1.73;  ///< Sensor above the ground; (0.2, 6).
  double roll_rad = 0;     ///< Positive lifts the left side; [-pi, pi], the ends are upside down.
  double pitch_rad = 0;    ///< Positive looks down in front; [-pi/2, pi/2]
};

/// The sensor's pose as found from the ground before and behind it.
struct FoundMount {
  Mount mount;
  /// Half the width of the 95 % interval.
  Mount uncertainty;
  std::size_t frames = 0;  ///< The number used.
};

/// The calibration table of one unit. A value: copies share the table.
class Calibration {
 public:
  /// Reads Velodyne's db.xml or the ROS driver's yaml of an HDL-64E, or RoboSense's angle.csv of an
  /// RS-Ruby128. kNotFound, kUnreadable or kMalformed, with file and line.
  [[nodiscard]] static Expected<Calibration> load(const std::filesystem::path& file);
  /// Returns the model's table, for when the unit's own is not at hand. Heights of an HDL-64E and
  /// an RS-Ruby128 are then some centimetres off; the other sensors have no other table.
  [[nodiscard]] static Calibration nominal(Sensor sensor);

  [[nodiscard]] Sensor sensor() const noexcept;
  /// Hashes all values that decide on coordinates; equal for the same unit in any file format.
  [[nodiscard]] std::uint64_t fingerprint() const;
  /// Says where the table comes from: a file's path, "the packets of ...", "nominal".
  [[nodiscard]] const std::string& origin() const;

  struct Table;  // defined in calib/api/calibration_table.hpp; not installed
  explicit Calibration(std::shared_ptr<const Table> table) noexcept;
  [[nodiscard]] const Table& table() const noexcept { return *table_; }

 private:
  std::shared_ptr<const Table> table_;
};

}  // namespace terracut
