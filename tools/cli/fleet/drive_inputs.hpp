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

/// Returns the inputs that the manifest names for a drive, and a calibration that lies beside its
/// capture.
[[nodiscard]] std::vector<DriveInput> inputs_of(const FleetDrive& drive);

/// Returns sizes and change times of a drive's inputs by role. If they stay equal, the input was
/// not written, replaced or renamed in between, whatever its modification time says. For a folder
/// they cover all its clouds. Fails with kNotFound or kUnreadable.
[[nodiscard]] Expected<nlohmann::ordered_json> stamps_of(const FleetDrive& drive);

/// Returns the SHA-256 of an input's content, for a folder that of its clouds' names and contents;
/// paths and times do not matter. Fails with kNotFound, kUnreadable, or kNothingCameOut when
/// stop_wanted().
[[nodiscard]] Expected<std::string> content_of(const DriveInput& input);

}  // namespace terracut::cli
