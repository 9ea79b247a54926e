// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "rt/error.hpp"
#include "terracut/frame.hpp"

namespace terracut::scan {

/// The most points of a scan. No HDL-64E frame can have so many (64 lasers x 4167 firings at 5 Hz,
/// two returns).
inline constexpr std::size_t kMaxScanPoints = std::size_t{1} << 20;

/// One point of a KITTI `.bin` file.
using ScanPoint = CloudPoint;

/// True if the point has a valid position. Not valid are NaN, infinity, positions farther than any
/// return can be (10 km), and the null point (0, 0, 0), which many programs write where a beam had
/// no return.
[[nodiscard]] inline bool is_place(const ScanPoint& point) noexcept {
  constexpr float kFarthest_m = 1e4F;
  if (point.x_m == 0 && point.y_m == 0 && point.z_m == 0) return false;
  return std::abs(point.x_m) <= kFarthest_m && std::abs(point.y_m) <= kFarthest_m &&
         std::abs(point.z_m) <= kFarthest_m;
}

/// Returns the azimuth of a point in [0, 2 pi) radians, clockwise from straight ahead seen from
/// above, as the sensor rotates and as the range image counts its columns. -0.0 counts as 0.
[[nodiscard]] inline double azimuth_rad(double x_m, double y_m) noexcept {
  constexpr double kRevolution_rad = 6.283185307179586476925286766559;
  const double azimuth = std::atan2(0.0 - y_m, x_m);  // 0 - y avoids a negative zero
  if (azimuth >= 0) return azimuth;
  const double wrapped = azimuth + kRevolution_rad;
  return wrapped < kRevolution_rad ? wrapped : 0.0;  // the sum may round up to 2 pi
}

/// Converts a remission of 0..1 to the sensor's intensity 0..255; other values are clamped.
[[nodiscard]] inline std::uint8_t intensity_of(float remission) noexcept {
  const float dark_or_more = remission > 0.0F ? remission : 0.0F;  // NaN becomes 0
  const float share = dark_or_more < 1.0F ? dark_or_more : 1.0F;
  return static_cast<std::uint8_t>(double{share * 255.0F} + 0.5);
}

/// Finds the factor that converts a file's intensities to remissions 0..1. Programs write 0..1, the
/// sensor's 0..255, or 16 bits; the brightest point tells which.
class RemissionScale {
 public:
  void add(float intensity) noexcept {
    if (intensity <= kMost) brightest_ = intensity > brightest_ ? intensity : brightest_;
  }
  [[nodiscard]] float factor() const noexcept {
    if (brightest_ <= 1.0F) return 1.0F;
    return 1.0F / (brightest_ <= 255.0F ? 255.0F : kMost);
  }

 private:
  static constexpr float kMost = 65535.0F;
  float brightest_ = 0;
};

/// Reads the points of a KITTI `.bin`, with remissions 0..1; the file may be empty. Fails with
/// kNotFound, kUnreadable or kMalformed (cut off, too large, or with five floats a point); the
/// message names the file.
[[nodiscard]] Status read_kitti_points(const std::filesystem::path& bin_file,
                                       std::vector<ScanPoint>& points);

/// One recorded frame; its buffers keep their memory from scan to scan.
struct KittiScan {
  std::vector<ScanPoint> points;  ///< Points in the file's order: ring after ring from the top.
  /// SemanticKITTI labels of the points; empty without a label file.
  std::vector<std::uint32_t> labels;
  /// Points without a valid position (is_place()); they stay in the list.
  std::size_t no_place = 0;
};

/// Reads a KITTI `.bin` (little-endian float32 x y z remission per point, no header) into `scan`
/// and empties its labels. Fails with kNotFound, kUnreadable or kMalformed (empty, truncated, too
/// large, no point with a valid position); the message names the file.
[[nodiscard]] Status read_kitti_scan(const std::filesystem::path& bin_file, KittiScan& scan);

/// Also reads the labels in `label_file`, one for every point. Fails with kMalformed if the counts
/// differ.
[[nodiscard]] Status read_kitti_scan(const std::filesystem::path& bin_file,
                                     const std::filesystem::path& label_file, KittiScan& scan);

}  // namespace terracut::scan
