// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/hdl64e/firing_times.hpp"
#include "firmware_io/scan/ring_table.hpp"

namespace terracut::encode {

/// Estimates the spin rate of an HDL-64E from its recorded scans. A laser fires every 48 us and
/// returns at most once each time, so the ring with the most points has about as many points as
/// there were firings in the frame. (In the KITTI recordings there are 2114 to 2172; the scan
/// intervals of 103.4 to 104.2 ms in their times.txt are 2154 to 2171 times 48 us.)
class RecordedSpin {
 public:
  /// Adds a scan: the ring of every point, or kNoRing.
  void add(std::span<const std::int16_t> ring_of_point) {
    std::vector<std::int64_t> points(1);
    for (const std::int16_t ring : ring_of_point) {
      if (ring == scan::kNoRing) continue;
      const auto index = static_cast<std::size_t>(ring);
      if (index >= points.size()) points.resize(index + 1);
      ++points[index];
    }
    longest_ring_ = std::max(longest_ring_, *std::ranges::max_element(points));
  }

  /// Returns at least 5 Hz, the head's slowest rate, and at most 10 Hz: if every ring is short, the
  /// view may be cropped or open to the sky.
  [[nodiscard]] double spin_hz() const noexcept {
    constexpr double kSlowest_hz = 5, kFastest_hz = 10;
    if (longest_ring_ == 0) return kFastest_hz;
    return std::clamp(1 / (kFiring_s * static_cast<double>(longest_ring_)), kSlowest_hz,
                      kFastest_hz);
  }
  /// Returns the firings per frame, rounded.
  [[nodiscard]] int firings() const noexcept {
    return static_cast<int>(std::lround(1 / (kFiring_s * spin_hz())));
  }

 private:
  static constexpr double kFiring_s = hdl64e::kFiringTimesSingle48.column_ns * 1e-9;

  std::int64_t longest_ring_ = 0;  ///< Number of points in the longest ring.
};

}  // namespace terracut::encode
