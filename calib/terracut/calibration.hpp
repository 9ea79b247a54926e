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

/// The sensor's pose above the ground. The vehicle frame has x ahead, y to the left, z up, and its
/// origin on the ground below the sensor.
struct Mount {
  double height_m = 1.73;  ///< Height of the sensor above the ground, inside (0.2, 6).
  /// Positive lifts the left side. In [-pi, pi]; at the ends the sensor is upside down.
  double roll_rad = 0;
  double pitch_rad = 0;  ///< Positive looks down in front. In [-pi/2, pi/2].
};

/// The sensor's pose as found from the ground in front of and behind the sensor.
struct FoundMount {
  Mount mount;
  /// Half the width of the 95 % interval of each figure.
  Mount uncertainty;
  std::size_t frames = 0;  ///< Number of frames the pose was found from.
};

/// The calibration table of one unit. Cheap to copy: copies share the table.
class Calibration {
 public:
  /// Reads an HDL-64E's table (Velodyne's db.xml or the ROS driver's yaml), a RoboSense's
  /// (angle.csv), a Hesai's (the CSV file that comes with the unit) or an Ouster's (its
  /// metadata, .json). Fails with kNotFound, kUnreadable, kMalformed or kUnsupported; the message
  /// names file and line or field.
  [[nodiscard]] static Expected<Calibration> load(const std::filesystem::path& file);
  /// Returns the model's table, for use if the unit's own is not at hand. Heights of an HDL-64E, an
  /// RS-Ruby128 and a Hesai are then some centimetres off. Other RoboSenses and Ousters cannot be
  /// decoded with it (angles are the unit's, as is an Ouster's profile). Units of the other models
  /// have no table of their own.
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
