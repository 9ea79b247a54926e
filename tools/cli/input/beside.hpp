// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "firmware_io/capture/file_kind.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// The one file of those names that is in the folder; empty: none. kMalformed where there are more.
[[nodiscard]] inline Expected<std::filesystem::path> only_one(
    const std::filesystem::path& folder, const std::vector<std::string>& names) {
  std::vector<std::filesystem::path> found;
  std::error_code none;
  for (const std::string& name : names) {
    if (std::filesystem::is_regular_file(folder / name, none)) found.push_back(folder / name);
  }
  if (found.size() > 1) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{} and {}: either might be meant; name the right one as the drive, "
                            "beside it, or take one away",
                            found[0].string(), found[1].string()));
  }
  return found.empty() ? std::filesystem::path() : found.front();
}

/// A capture's name without its ending.
[[nodiscard]] inline std::string stem_of(const std::filesystem::path& capture) {
  const std::string name = capture.filename().string();
  const std::string_view stem = capture::capture_stem(name);
  return stem.empty() ? name : std::string(stem);
}

/// What a capture's calibration beside it ends in, behind the capture's own stem.
[[nodiscard]] inline std::vector<std::string> calibration_endings() {
  return {".calibration.xml", ".calibration.yaml", ".calibration.csv"};
}

/// Of a capture's own name; empty: none. The errors of only_one().
[[nodiscard]] inline Expected<std::filesystem::path> calibration_beside(
    const std::filesystem::path& capture) {
  std::vector<std::string> names;
  for (const std::string& ending : calibration_endings()) {
    names.push_back(stem_of(capture) + ending);
  }
  return only_one(capture.parent_path(), names);
}

}  // namespace terracut::cli
