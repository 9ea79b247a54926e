// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "calib/mount/mount.hpp"
#include "calib/mount/ring_profile.hpp"
#include "rt/error.hpp"

namespace terracut::mount {

/// What `terracut calibrate` found out about one vehicle: written by it, read by `--setup FILE`.
///
///     # terracut sensor setup
///     mount: {height_m: 1.73, roll_deg: 0.2, pitch_deg: -0.4}
///     rings:
///       ground_distance_m: [3.7, 3.8, ..., .inf]    # optional, one a row, lowest elevation first
struct SensorSetup {
  Mount mount;
  /// Mean horizontal ground distance of each row, row 0 the lowest; infinite where a ring does not
  /// reach the ground. Empty: take them from the geometry.
  std::vector<double> ring_ground_distance_m;
};

/// Reads a setup. roll_deg and pitch_deg may be left out (0), height_m may not. Unknown or repeated
/// keys, numbers outside the ranges of Mount and ring distances that are not positive are errors
/// that name the file and the line.
[[nodiscard]] Expected<SensorSetup> read_sensor_setup(const std::filesystem::path& path);

/// The same from memory; `name` stands for the file in errors.
[[nodiscard]] Expected<SensorSetup> parse_sensor_setup(std::span<const char> text,
                                                       const std::string& name);

/// Writes a setup, whole or not at all.
[[nodiscard]] Status write_sensor_setup(const std::filesystem::path& path,
                                        const SensorSetup& setup);

/// Puts the setup into a profile from ring_profile(): its mount and, where given, its distances.
/// kInvalidArgument when the number of distances is not the profile's number of rings.
[[nodiscard]] Status apply_setup(const SensorSetup& setup, RingProfile& profile);

}  // namespace terracut::mount
