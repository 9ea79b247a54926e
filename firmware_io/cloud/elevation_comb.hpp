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

/// Finds the lasers of a sensor from its points alone: if all beams start near the origin, the
/// elevations of the points form a comb with one tooth per laser. Fails where there is no such
/// comb: in frames that are compensated for motion or merged from several sensors, and for sensors
/// without rows. Lasers that see nothing beyond a metre, such as those that look at the floor
/// around a robot, are found if their near points form teeth.
class ElevationComb {
 public:
  void add(std::span<const scan::ScanPoint> points);

  /// Returns the elevation of each laser from the highest down, radians. Fails with kUnsupported if
  /// the elevations do not form kFewestLasers to kMostLasers teeth with gaps between them; the
  /// message says what was found.
  [[nodiscard]] Expected<std::vector<double>> elevations_rad() const;

 private:
  static constexpr int kBinsPerDegree = 100;  ///< The densest sensors' rows are 0.1 degrees apart.
  static constexpr std::size_t kBins = 180 * kBinsPerDegree;

  /// Counts points by elevation, beginning straight below the sensor.
  struct Histogram {
    std::array<std::uint32_t, kBins> points_at{};
    std::size_t points = 0;

    void add(std::size_t bin) noexcept {
      ++points_at[bin];
      ++points;
    }
  };
  /// A run of filled bins, [begin, end).
  struct Tooth {
    std::size_t begin, end;
    std::uint64_t points = 0;
    double mean_bin = 0;
    bool is_narrow = false;  ///< True if the tooth is narrower than the gaps beside it.

    [[nodiscard]] std::size_t bins() const noexcept { return end - begin; }
  };
  struct Comb {
    std::vector<Tooth> teeth;
    double share_in_teeth = 0;  ///< Share of the points in narrow teeth.
    bool is_comb = false;
  };

  [[nodiscard]] static Comb comb_of(const Histogram& histogram);
  [[nodiscard]] static std::vector<Tooth> rows_seen_nearby(const Comb& all,
                                                           const std::vector<Tooth>& far);

  Histogram far_, all_;
};

}  // namespace terracut::cloud
