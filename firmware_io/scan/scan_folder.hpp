// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rt/error.hpp"

namespace terracut::scan {

/// One recorded frame on disk.
struct ScanFile {
  std::filesystem::path points;  ///< The scan itself.
  std::optional<std::filesystem::path>
      labels;        ///< The `.label` file of the same name, if there is one.
  std::string name;  ///< "000009" of 000009.bin and of 000009.pcd.bin.
  /// The frame number in the name, for poses and times; empty if the name is not a number.
  std::optional<std::uint32_t> frame;
};

/// Recorded scans in order of their names.
struct ScanFolder {
  std::vector<ScanFile> scans;                 ///< Never empty.
  std::optional<std::filesystem::path> poses;  ///< poses.txt of a sequence folder.
  std::optional<std::filesystem::path> times;  ///< times.txt
  std::optional<std::filesystem::path> calib;  ///< calib.txt
};

/// How scans are told from other files of a folder, by name.
struct ScanKind {
  bool (*is_scan)(const std::filesystem::path&);
  std::string_view formats;  ///< Named in messages: "KITTI's .bin (float32 x y z remission)".
};
/// True for a name that ends in `.bin`.
[[nodiscard]] bool is_kitti_bin(const std::filesystem::path& path);
inline constexpr ScanKind kKittiScans{is_kitti_bin, "KITTI's .bin (float32 x y z remission)"};

/// Lists a SemanticKITTI sequence folder (velodyne/ with scans, labels/ with .label, poses.txt,
/// times.txt, calib.txt; all but velodyne/ optional) or a plain folder of scans with .label files
/// beside them, or a single scan. Scans may lack labels. Hidden files are ignored: macOS puts a
/// `._000000.bin` beside a 000000.bin. Fails with kNotFound (no such folder, no scan in it),
/// kUnreadable, kUnsupported (a file whose name is not a scan's), kMalformed (two scans of one
/// name, whose outputs would overwrite each other).
[[nodiscard]] Expected<ScanFolder> list_scan_folder(const std::filesystem::path& folder,
                                                    const ScanKind& kind = kKittiScans);

}  // namespace terracut::scan
