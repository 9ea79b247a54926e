// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>

#include "firmware_io/cloud/cloud.hpp"
#include "firmware_io/scan/scan_folder.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// Whether the file's name is that of a cloud: .bin, .pcd or .ply, in upper case, too.
[[nodiscard]] bool is_cloud_file(const std::filesystem::path& path);
/// Those of a folder.
inline constexpr scan::ScanKind kCloudFiles{
    is_cloud_file, "KITTI's .bin (float32 x y z remission), nuScenes' .pcd.bin, .pcd or .ply"};

/// Reads a cloud by the ending of its name:
///
///   .pcd.bin  nuScenes: float32 x y z intensity ring, x to the right, y ahead (turned to ours)
///   .bin      KITTI: float32 x y z remission
///   .pcd      fields x y z; intensity, remission or reflectivity; ring, channel, laser or row;
///             organised by HEIGHT; others, as azimuth and time, are not needed
///   .ply      the same by its properties
///
/// Intensity above 1 counts as 0..255. Errors name the file: those of its format, kMalformed for a
/// missing x, y or z, for lasers that are no whole numbers from 0 to 255, or where no point is a
/// place (scan::is_place()).
[[nodiscard]] Status read_cloud(const std::filesystem::path& path, Cloud& cloud);

/// Reads nuScenes' format, whatever the file's name and wherever its points are.
[[nodiscard]] Status read_nuscenes_bin(const std::filesystem::path& path, Cloud& cloud);

}  // namespace terracut::cloud
