// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_table.hpp"

namespace terracut::cloud {

/// Finds the ring nearest to a point from its position alone. Uses plain IEEE arithmetic: the
/// result is the same on every machine.
class NearestRing {
 public:
  /// Needs a table of at least two rings.
  explicit NearestRing(const scan::RingTable& table);

  /// Returns the ring. Returns scan::kNoRing for a point without a valid position, and for a point
  /// outside the outermost rings by more than a degree and by more than the distance to the next
  /// ring. Allocates nothing.
  [[nodiscard]] std::int16_t operator()(const scan::ScanPoint& point) const noexcept;

 private:
  struct Line {
    /// `most_off` is the largest accepted vertical distance from the line, per metre of distance.
    float slope, offset_m, most_off;
  };

  /// The number of bins over the sine of the elevation; each bin holds the ring to start from.
  static constexpr int kBins = 8192;

  std::vector<Line> lines_;
  std::vector<std::int16_t> ring_at_;
};

}  // namespace terracut::cloud
