// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "manifest.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// A file, or a folder of clouds, from which a drive's labels are made.
struct DriveInput {
  std::string_view role;  ///< "capture" and so on, as in the manifest.
  std::filesystem::path path;
};

/// Returns the inputs named by the manifest, and a calibration beside a capture.
[[nodiscard]] std::vector<DriveInput> inputs_of(const FleetDrive& drive);

/// Returns sizes and change times by role, for comparison: an input with equal stamps was not
/// written, replaced or renamed in between, whatever its modification time says. For a folder,
/// those of all its clouds. kNotFound, kUnreadable.
[[nodiscard]] Expected<nlohmann::ordered_json> stamps_of(const FleetDrive& drive);

/// Returns SHA-256 of an input's content; of a folder, that of its clouds' names and contents. Path
/// and times do not count. kNotFound, kUnreadable; kNothingCameOut when stop_wanted().
[[nodiscard]] Expected<std::string> content_of(const DriveInput& input);

}  // namespace terracut::cli
