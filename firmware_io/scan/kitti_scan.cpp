// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/kitti_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <span>
#include <system_error>

#include "firmware_io/scan/label_file.hpp"
#include "rt/files/record_file.hpp"

namespace terracut::scan {

namespace {

constexpr std::size_t kFloatsOfFive = 5;
constexpr const char* kFiveFloats =
    "; are these 5 floats a point (x y z intensity ring)? Then name it .pcd.bin";

/// True if the floats are points of nuScenes, with five numbers each: x, y, z, intensity and laser
/// number. In a KITTI file every fifth float is a coordinate or a remission, so they are never all
/// laser numbers.
bool has_five_floats(std::span<const ScanPoint> points) {
  const std::size_t floats = points.size() * 4;
  if (floats % kFloatsOfFive != 0) return false;
  std::bitset<256> lasers;
  for (std::size_t i = kFloatsOfFive - 1; i < floats; i += kFloatsOfFive) {
    const ScanPoint& point = points[i / 4];
    const float number = std::array{point.x_m, point.y_m, point.z_m, point.remission}[i % 4];
    if (!(number >= 0 && number < 256) || number != std::floor(number)) return false;
    lasers.set(static_cast<std::size_t>(number));
  }
  constexpr std::size_t kFewestLasers = 8;
  return lasers.count() >= kFewestLasers;
}

}  // namespace

Status read_kitti_points(const std::filesystem::path& bin_file, std::vector<ScanPoint>& points) {
  static_assert(sizeof(ScanPoint) == 16);
  const files::RecordLayout layout{"point of 4 float32 (x y z remission)", sizeof(ScanPoint),
                                   kMaxScanPoints, true};
  if (Status status = files::read_records(bin_file, layout, points); !status) {
    std::error_code none;
    const std::uintmax_t bytes = std::filesystem::file_size(bin_file, none);
    if (none || bytes % sizeof(ScanPoint) == 0) return status;
    if (bytes % (kFloatsOfFive * sizeof(float)) == 0) {
      status.error().message += kFiveFloats;
    } else if (bytes % (3 * sizeof(float)) == 0) {
      status.error().message += "; are these 3 or 6 floats a point? Expected are 4";
    }
    return status;
  }
  if (has_five_floats(points)) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: every fifth float is a whole number from 0 to 255{}",
                            bin_file.string(), kFiveFloats));
  }
  RemissionScale scale;
  for (const ScanPoint& point : points) scale.add(point.remission);
  if (scale.factor() == 1.0F) return {};
  for (ScanPoint& point : points) point.remission *= scale.factor();
  return {};
}

Status read_kitti_scan(const std::filesystem::path& bin_file, KittiScan& scan) {
  scan.labels.clear();
  scan.no_place = 0;
  if (Status status = read_kitti_points(bin_file, scan.points); !status) return status;
  scan.no_place = static_cast<std::size_t>(std::count_if(
      scan.points.begin(), scan.points.end(), [](const ScanPoint& p) { return !is_place(p); }));
  if (scan.points.empty()) {
    return fail(ErrorCode::kMalformed, bin_file.string() + ": empty; expected points");
  }
  if (scan.no_place == scan.points.size()) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: none of the {} points is finite and not null; expected float32 x "
                            "y z remission",
                            bin_file.string(), scan.points.size()));
  }
  return {};
}

Status read_kitti_scan(const std::filesystem::path& bin_file,
                       const std::filesystem::path& label_file, KittiScan& scan) {
  if (const Status status = read_kitti_scan(bin_file, scan); !status) return status;
  return read_label_file(label_file, scan.points.size(), scan.labels);
}

}  // namespace terracut::scan
