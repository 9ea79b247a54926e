// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/scan_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <tuple>

#include "rt/files/ending.hpp"
#include "rt/number_of.hpp"

namespace terracut::scan {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> if_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  return path;
}

ScanFile scan_file(const fs::path& path, const fs::path& labels) {
  fs::path stem = path.stem();
  if (files::ending_of(stem) == ".pcd") stem = stem.stem();  // for .pcd.bin
  const std::string name = stem.string();
  return {path, if_file(labels / (name + ".label")), name, rt::number_of<std::uint32_t>(name)};
}

}  // namespace

bool is_kitti_bin(const fs::path& path) {
  return files::ending_of(path) == ".bin";
}

Expected<ScanFolder> list_scan_folder(const fs::path& folder, const ScanKind& kind) {
  std::error_code error;
  if (fs::is_regular_file(folder, error)) {
    if (kind.is_scan(folder)) {
      return ScanFolder{{scan_file(folder, folder.parent_path())}, {}, {}, {}};
    }
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: no scan by its name; expected {}", folder.string(), kind.formats));
  }
  if (!fs::is_directory(folder, error)) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no such folder; expected a folder of scans or a SemanticKITTI "
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
    if (!kind.is_scan(path) || path.filename().native().starts_with('.')) continue;
    // A broken link counts as a scan: reading it reports the fault.
    if (!entry->is_regular_file(ignored) && !entry->is_symlink(ignored)) continue;
    found.scans.push_back(scan_file(path, labels));
  }
  if (error) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot be listed: {}", points.string(), error.message()));
  }
  if (found.scans.empty()) {
    return fail(
        ErrorCode::kNotFound,
        fmt::format("{}: no scan in it; expected {}, or a SemanticKITTI sequence folder with "
                    "velodyne/",
                    points.string(), kind.formats));
  }
  std::ranges::sort(found.scans, {},
                    [](const ScanFile& scan) { return std::tie(scan.name, scan.points.native()); });
  const auto twins = std::ranges::adjacent_find(found.scans, {}, &ScanFile::name);
  if (twins != found.scans.end()) {
    return fail(
        ErrorCode::kMalformed,
        fmt::format("{} and {}: two scans of one name, {}, whose outputs would be one file; keep "
                    "the files of each format in a folder of their own, or name one of the two "
                    "alone",
                    twins[0].points.string(), twins[1].points.string(), twins->name));
  }
  if (sequence) {
    found.poses = if_file(folder / "poses.txt");
    found.times = if_file(folder / "times.txt");
    found.calib = if_file(folder / "calib.txt");
  }
  return found;
}

}  // namespace terracut::scan
