// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>

#include "firmware_io/cloud/cloud.hpp"
#include "firmware_io/scan/scan_folder.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// True if the file's name ends in .bin, .pcd or .ply, in lower or upper case.
[[nodiscard]] bool is_cloud_file(const std::filesystem::path& path);
/// Cloud files of a folder.
inline constexpr scan::ScanKind kCloudFiles{
    is_cloud_file, "KITTI's .bin (float32 x y z remission), nuScenes' .pcd.bin, .pcd or .ply"};

/// Where the sensor stands among the points of a file.
enum class SensorPlace : std::uint8_t {
  kOrigin,
  kViewpoint,  ///< At a PCD's VIEWPOINT; at the origin if it has none.
};

/// Reads a cloud by the ending of its name:
///
///   .pcd.bin  nuScenes: float32 x y z intensity ring, x to the right, y ahead (turned to ours)
///   .bin      KITTI: float32 x y z remission
///   .pcd      fields x y z; those of kIntensityFields and kLaserFields, whole numbers from 0 to
///             255, in any case and with CloudCompare's `scalar_` before them; organised by HEIGHT;
///             others, as azimuth and time, are not needed
///   .ply      the same by its properties
///
/// Intensity above 1 counts as 0..255, above 255 as 16 bits. A cloud may be empty or have no point
/// with a place (scan::is_place()), as when the sensor is covered. Errors name the file: those of
/// its format, kMalformed for a missing x, y or z, and those of check_reach().
[[nodiscard]] Status read_cloud(const std::filesystem::path& path, Cloud& cloud,
                                SensorPlace sensor = SensorPlace::kOrigin);

/// Reads nuScenes' format, whatever the file's name and wherever its points are. kMalformed if a
/// laser's number is not a whole number from 0 to 255 at a point with a place.
[[nodiscard]] Status read_nuscenes_bin(const std::filesystem::path& path, Cloud& cloud);

}  // namespace terracut::cloud
