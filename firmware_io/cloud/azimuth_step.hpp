// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"

namespace terracut::cloud {

/// How often a laser fires in one revolution, by how far apart its points are: the median over the
/// neighbours of all rings, so that missing returns do not matter.
class AzimuthStep {
 public:
  /// The first few clouds are enough; later ones are not looked at.
  void add(std::span<const scan::ScanPoint> points, std::span<const std::int16_t> ring_of_point);

  /// Of a range image for these clouds, [360, 4500]. 2083, an HDL-64E's at 10 Hz and the image that
  /// all figures were measured with, where it is within 5 % of that: recorded scans of one have
  /// 1990 to 2013.
  [[nodiscard]] int columns() const;

 private:
  std::vector<float> steps_rad_;
  int clouds_ = 0;
};

}  // namespace terracut::cloud
