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
  std::string_view role;  ///< What the input is in the manifest: "capture" and so on.
  std::filesystem::path path;
};

/// Returns the inputs that the manifest names for a drive, and a calibration beside a capture.
[[nodiscard]] std::vector<DriveInput> inputs_of(const FleetDrive& drive);

/// Returns sizes and change times of a drive's inputs by role: an input with equal stamps was not
/// written, replaced or renamed in between, whatever its modification time says. A folder's stamps
/// are those of all its clouds. Fails with kNotFound or kUnreadable.
[[nodiscard]] Expected<nlohmann::ordered_json> stamps_of(const FleetDrive& drive);

/// Returns the SHA-256 of an input's content, for a folder of its clouds' names and contents; path
/// and times do not count. Fails with kNotFound, kUnreadable, or kNothingCameOut when
/// stop_wanted().
[[nodiscard]] Expected<std::string> content_of(const DriveInput& input);

}  // namespace terracut::cli
