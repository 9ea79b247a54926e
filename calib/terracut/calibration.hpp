// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "terracut/error.hpp"

namespace terracut {

enum class Sensor : std::uint8_t {
  kHdl64e,  ///< Any generation.
  kRuby128,
  kVlp16,
  kHdl32e,
  kVlp32c,
  kVls128
};

/// How the sensor stands above the ground. The vehicle frame has x ahead, y to the left, z up, and
/// its origin on the ground below the sensor.
struct Mount {
  double height_m = 1.73;  ///< Sensor above the ground; (0.2, 6).
  double roll_rad = 0;     ///< Left side up; [-pi, pi], either end being upside down.
  double pitch_rad = 0;    ///< Looking down in front; [-pi/2, pi/2]
};

/// How a sensor stands as the ground before and behind it shows.
struct FoundMount {
  Mount mount;
  /// Half the width of the interval that holds the true figure in 95 of 100 cases.
  Mount uncertainty;
  std::size_t frames = 0;  ///< It was read off.
};

/// The calibration table of one unit. A value: copies share the table.
class Calibration {
 public:
  /// Velodyne's db.xml or the ROS driver's yaml for an HDL-64E, RoboSense's angle.csv for an
  /// RS-Ruby128. kNotFound, kUnreadable or kMalformed, with file and line.
  [[nodiscard]] static Expected<Calibration> load(const std::filesystem::path& file);
  /// The model's table, when the unit's own is not at hand: heights of an HDL-64E and an RS-Ruby128
  /// are some centimetres off. Of the others there is none else.
  [[nodiscard]] static Calibration nominal(Sensor sensor);

  [[nodiscard]] Sensor sensor() const noexcept;
  /// Of all values that decide on coordinates; equal for the same unit in any file format.
  [[nodiscard]] std::uint64_t fingerprint() const;
  /// Where it comes from: a file's path, "the packets of ...", "nominal".
  [[nodiscard]] const std::string& origin() const;

  struct Table;  // calib/sensor_calibration.hpp; not installed
  explicit Calibration(std::shared_ptr<const Table> table) noexcept;
  [[nodiscard]] const Table& table() const noexcept { return *table_; }

 private:
  std::shared_ptr<const Table> table_;
};

}  // namespace terracut
