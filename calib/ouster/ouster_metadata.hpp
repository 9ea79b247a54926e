// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "calib/ouster/ouster_calibration.hpp"
#include "calib/sensor/sensor_model.hpp"
#include "rt/error.hpp"

/// Reads the metadata that an Ouster unit gives of itself, a `.json` file in either of its forms:
/// all in one map (firmware up to 2.3), or in maps by topic (`beam_intrinsics`,
/// `lidar_data_format`, ...). Allocates; start-up only; no exceptions.
namespace terracut::ouster {

/// Parses the text; `name` stands for the file in messages. Angles of the beams and the mode
/// (`lidar_mode`, or columns and rate by themselves) must be there. What old files leave out is
/// taken as their firmware had it: the legacy profile, 16 columns in a packet, beams 15.806 mm from
/// the axis, the lidar 36.18 mm above the base and turned by 180 degrees; `origin` says which
/// lengths were not given. Fails with kMalformed or kUnsupported (a profile or a size that is not
/// read).
[[nodiscard]] Expected<OusterCalibration> parse_ouster_metadata(std::string_view text,
                                                                const std::string& name);

/// Reads a file. Also fails with kNotFound and kUnreadable, and with kUnsupported if `wanted` has
/// other rows.
[[nodiscard]] Expected<OusterCalibration> read_ouster_metadata(
    const std::filesystem::path& path, std::optional<sensor::SensorModel> wanted = {});

/// Returns the text in the old form, from which parse_ouster_metadata() makes an equal table.
[[nodiscard]] std::string ouster_metadata_text(const OusterCalibration& calibration);

/// Writes the text to a file, whole or not at all.
[[nodiscard]] Status write_ouster_metadata(const std::filesystem::path& path,
                                           const OusterCalibration& calibration);

/// True if a file's name ends as that of metadata.
[[nodiscard]] bool is_metadata_name(const std::filesystem::path& path);

}  // namespace terracut::ouster
