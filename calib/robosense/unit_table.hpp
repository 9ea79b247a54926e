// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "calib/beams/beam_table.hpp"
#include "calib/robosense/angle_csv.hpp"
#include "rt/error.hpp"

/// The table of one unit of a RoboSense with 32 lasers. Start-up only: allocates.
namespace terracut::robosense {

/// Returns the table with these angles, one a channel. Fails with kMalformed if an elevation is
/// beyond 90 or an azimuth offset beyond 30 degrees, or if all elevations are equal.
[[nodiscard]] Expected<beams::BeamTable> table_of(sensor::SensorModel model,
                                                  std::span<const AngleLine> angles,
                                                  std::string origin);

/// Parses the content of an `angle.csv` (parse_angle_csv()); `name` stands for the file in errors
/// and becomes the origin. Without `wanted`, the table is an RS-LiDAR-32's if its elevations are
/// those of that model within 3 degrees, otherwise a Helios's, of which there are several. Fails
/// with kUnsupported if the table is not of the `wanted` model.
[[nodiscard]] Expected<beams::BeamTable> parse_unit_csv(
    std::span<const char> text, const std::string& name,
    std::optional<sensor::SensorModel> wanted = {});
/// Reads such a file. Fails with kNotFound, kUnreadable, too.
[[nodiscard]] Expected<beams::BeamTable> read_unit_csv(
    const std::filesystem::path& path, std::optional<sensor::SensorModel> wanted = {});

/// Returns the content of an `angle.csv`, in thousandths of a degree; parsing it gives the same
/// fingerprint().
[[nodiscard]] std::string unit_csv_text(const beams::BeamTable& table);

/// Writes unit_csv_text(), whole or not at all. Fails with kInvalidArgument if the table fails
/// validate(), kWriteFailed if the file cannot be written.
[[nodiscard]] Status write_unit_csv(const std::filesystem::path& path,
                                    const beams::BeamTable& table);

}  // namespace terracut::robosense
