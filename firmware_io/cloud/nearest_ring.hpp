// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_table.hpp"

namespace terracut::cloud {

/// The ring of a point by nothing but its place: the nearest one's. Plain IEEE arithmetic, so the
/// same on every machine.
class NearestRing {
 public:
  /// `table`: at least two rings.
  explicit NearestRing(const scan::RingTable& table);

  /// scan::kNoRing for what is no place and for points more than a degree, or a ring's distance to
  /// its neighbour, beyond the outermost rings. Allocates nothing.
  [[nodiscard]] std::int16_t operator()(const scan::ScanPoint& point) const noexcept;

 private:
  struct Line {
    float slope, offset_m,
        most_off;  ///< Height over distance; beyond it lies no point of the ring.
  };

  /// Rings by the sine of the elevation, a bin each.
  static constexpr int kBins = 8192;

  std::vector<Line> lines_;
  std::vector<std::int16_t> ring_at_;
};

}  // namespace terracut::cloud
