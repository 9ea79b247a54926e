// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/scan_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "rt/number_of.hpp"

namespace terracut::scan {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> if_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  return path;
}

}  // namespace

Expected<ScanFolder> list_scan_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return fail(
        ErrorCode::kNotFound,
        fmt::format("{}: no such folder; expected a folder of .bin scans or a SemanticKITTI "
                    "sequence folder with velodyne/",
                    folder.string()));
  }
  const bool sequence = fs::is_directory(folder / "velodyne", error);
  const fs::path points = sequence ? folder / "velodyne" : folder;
  const fs::path labels = sequence ? folder / "labels" : folder;

  ScanFolder found;
  fs::directory_iterator entry(points, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const fs::path& path = entry->path();
    std::error_code ignored;
    if (path.extension() != ".bin") continue;
    // A link that leads nowhere is a scan all the same: reading it says what is wrong.
    if (!entry->is_regular_file(ignored) && !entry->is_symlink(ignored)) continue;
    const std::string name = path.stem().string();
    found.scans.push_back(
        {path, if_file(labels / (name + ".label")), name, rt::number_of<std::uint32_t>(name)});
  }
  if (error) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot be listed: {}", points.string(), error.message()));
  }
  if (found.scans.empty()) {
    return fail(
        ErrorCode::kNotFound,
        fmt::format("{}: no .bin file in it; expected KITTI scans (float32 x y z remission), "
                    "or a SemanticKITTI sequence folder with velodyne/",
                    points.string()));
  }
  std::sort(found.scans.begin(), found.scans.end(),
            [](const ScanFile& a, const ScanFile& b) { return a.name < b.name; });
  if (sequence) {
    found.poses = if_file(folder / "poses.txt");
    found.times = if_file(folder / "times.txt");
    found.calib = if_file(folder / "calib.txt");
  }
  return found;
}

}  // namespace terracut::scan
