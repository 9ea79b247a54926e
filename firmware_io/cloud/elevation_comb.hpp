// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// Finds the lasers of a sensor in nothing but its points: where all beams start near the origin,
/// the elevations of their points stand like the teeth of a comb. They do not where a frame was
/// compensated for motion or put together from several, and with a sensor without rows; that is
/// refused.
class ElevationComb {
 public:
  void add(std::span<const scan::ScanPoint> points);

  /// Elevation of each laser from the highest down, radians. kUnsupported where the elevations do
  /// not form kFewestLasers to kMostLasers teeth with gaps between them; the message says what was
  /// found.
  [[nodiscard]] Expected<std::vector<double>> elevations_rad() const;

 private:
  static constexpr int kBinsPerDegree = 100;  ///< The densest sensors' rows are 0.1 degrees apart.
  static constexpr std::size_t kBins = 180 * kBinsPerDegree;

  std::array<std::uint32_t, kBins> points_at_{};  ///< From straight down.
  std::size_t points_ = 0;
};

}  // namespace terracut::cloud
