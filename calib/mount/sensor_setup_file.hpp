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

/// What `terracut calibrate` found for one vehicle; `--setup FILE` reads it from a file:
///
///     # terracut sensor setup
///     mount: {height_m: 1.73, roll_deg: 0.2, pitch_deg: -0.4}
///     rings:
///       ground_distance_m: [3.7, 3.8, ..., .inf]    # optional, one a row, lowest elevation first
struct SensorSetup {
  Mount mount;
  /// Mean horizontal ground distance of each row, row 0 the lowest; infinite for a ring that does
  /// not reach the ground. If empty, the distances follow from the calibration.
  std::vector<double> ring_ground_distance_m;
};

/// Reads a setup. height_m is required; roll_deg and pitch_deg default to 0. Fails on unknown or
/// repeated keys, numbers outside Mount's ranges and ring distances that are not positive; the
/// message names the file and the line.
[[nodiscard]] Expected<SensorSetup> read_sensor_setup(const std::filesystem::path& path);

/// Parses the content of a setup file; `name` stands for the file in errors.
[[nodiscard]] Expected<SensorSetup> parse_sensor_setup(std::span<const char> text,
                                                       const std::string& name);

/// Writes a setup, whole or not at all.
[[nodiscard]] Status write_sensor_setup(const std::filesystem::path& path,
                                        const SensorSetup& setup);

/// Puts the setup into a profile from ring_profile(): its mount and, if given, its distances. Fails
/// with kInvalidArgument if the number of distances is not the profile's number of rings.
[[nodiscard]] Status apply_setup(const SensorSetup& setup, RingProfile& profile);

}  // namespace terracut::mount
