// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>

#include "firmware_io/cloud/cloud.hpp"
#include "firmware_io/scan/scan_folder.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// True if the file's name ends in .bin, .pcd or .ply, in either case.
[[nodiscard]] bool is_cloud_file(const std::filesystem::path& path);
/// Tells which files of a folder are clouds, and names their formats for messages.
inline constexpr scan::ScanKind kCloudFiles{
    is_cloud_file, "KITTI's .bin (float32 x y z remission), nuScenes' .pcd.bin, .pcd or .ply"};

/// The sensor's position among the points of a file.
enum class SensorPlace : std::uint8_t {
  kOrigin,
  kViewpoint,  ///< At a PCD file's VIEWPOINT; without one, at the origin.
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
/// Intensities up to 1 are scaled to 0..255, those above 255 count as 16 bits. A cloud may be empty
/// or have no point with a valid position (scan::is_place()), as when the sensor is covered. Fails
/// with the errors of the file's format, kMalformed for a missing x, y or z, and those of
/// check_reach(); the message names the file.
[[nodiscard]] Status read_cloud(const std::filesystem::path& path, Cloud& cloud,
                                SensorPlace sensor = SensorPlace::kOrigin);

/// Reads nuScenes' format, whatever the file's name, without check_reach(). Fails with kMalformed
/// if the laser number of a point with a valid position is not a whole number from 0 to 255.
[[nodiscard]] Status read_nuscenes_bin(const std::filesystem::path& path, Cloud& cloud);

}  // namespace terracut::cloud
