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
/// refused. Lasers that see nothing beyond a metre, as those that look down at the floor around a
/// robot, are found where near points stand like teeth, too.
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

  /// Points by elevation, from straight down.
  struct Histogram {
    std::array<std::uint32_t, kBins> points_at{};
    std::size_t points = 0;

    void add(std::size_t bin) noexcept {
      ++points_at[bin];
      ++points;
    }
  };
  /// Bins next to each other, [begin, end).
  struct Tooth {
    std::size_t begin, end;
    std::uint64_t points = 0;
    double mean_bin = 0;
    bool is_narrow = false;  ///< Narrower than the gaps beside it.

    [[nodiscard]] std::size_t bins() const noexcept { return end - begin; }
  };
  struct Comb {
    std::vector<Tooth> teeth;
    double share_in_teeth = 0;  ///< Of the points: in narrow teeth.
    bool is_comb = false;
  };

  [[nodiscard]] static Comb comb_of(const Histogram& histogram);
  [[nodiscard]] static std::vector<Tooth> rows_seen_nearby(const Comb& all,
                                                           const std::vector<Tooth>& far);

  Histogram far_, all_;
};

}  // namespace terracut::cloud
