// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_table.hpp"

namespace terracut::encode {

/// A recorded scan as seen from its origin: how far the world lies in any direction, as far as the
/// recording tells.
///
/// Between neighbouring returns of one surface the inverse of the range is interpolated, which is
/// exact on planes; at edges the nearer return in angle stands for itself; where the recording has
/// no return near by, or had none beside it, there is nothing. Two returns are of one surface when
/// neither their labels (all ground counts as one) nor a leap in range say otherwise.
///
/// Directions: azimuth clockwise from straight ahead, any revolution; elevation up; radians. Allocates.
class ScanSurface {
 public:
  /// What a ray meets.
  struct Sight {
    double range_m = 0;       ///< From the origin.
    std::uint32_t point = 0;  ///< The nearest return that tells of it: its index in the scan.
  };

  ScanSurface();

  /// Takes another scan. `ring_of_point`: 0 (top) .. 63 or kNoRing for each point; `labels`: one
  /// for each point, or empty. Points without ring or place are left out.
  void take(std::span<const scan::ScanPoint> points, std::span<const std::int16_t> ring_of_point,
            std::span<const std::uint32_t> labels);

  [[nodiscard]] std::optional<Sight> look(double azimuth_rad, double elevation_rad) const;

  /// The elevation lies between the scan's topmost and lowest ring, or hardly beside them.
  [[nodiscard]] bool covers(double elevation_rad) const noexcept;

 private:
  struct Spot {
    double azimuth_rad = 0, elevation_rad = 0, range_m = 0;
    std::uint32_t label = 0, point = 0;
  };
  /// A ring at one azimuth.
  struct Crossing {
    double elevation_rad = 0, range_m = 0;
    std::uint32_t label = 0, point = 0;
    std::int16_t ring = 0;
  };
  struct Ring {
    std::vector<Spot> spots;           ///< By azimuth.
    std::vector<std::uint32_t> begin;  ///< By bin: the first spot that is not before it.
  };
  struct Candidate {
    float elevation_rad = 0;
    std::int16_t ring = 0;
  };

  [[nodiscard]] std::optional<Crossing> cross(int ring, double azimuth_rad) const;
  void index(Ring& ring) const;
  void list_candidates();
  void measure_span();

  std::array<Ring, scan::kScanRings> rings_;
  std::vector<std::vector<Candidate>> columns_;  ///< By bin: the rings there, by elevation.
  double highest_rad_ = 0, lowest_rad_ = 0;
};

}  // namespace terracut::encode
