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

/// A file, or a folder of clouds, that a drive's labels come from.
struct DriveInput {
  std::string_view role;  ///< "capture", as in the manifest.
  std::filesystem::path path;
};

/// Those that the manifest names, and a calibration that lies beside a capture.
[[nodiscard]] std::vector<DriveInput> inputs_of(const FleetDrive& drive);

/// Lengths and times of change by role, in some form: what has the same as before has not been
/// written to, replaced or renamed since, whatever its time of writing was set to. Of a folder, of
/// all its clouds. kNotFound, kUnreadable.
[[nodiscard]] Expected<nlohmann::ordered_json> stamps_of(const FleetDrive& drive);

/// SHA-256 of what is in it; of a folder, of its clouds' names and theirs. Neither its place nor
/// its times count. kNotFound, kUnreadable; kNothingCameOut when stop_wanted().
[[nodiscard]] Expected<std::string> content_of(const DriveInput& input);

}  // namespace terracut::cli
