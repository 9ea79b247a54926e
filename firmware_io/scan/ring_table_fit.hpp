// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_table.hpp"
#include "rt/error.hpp"

namespace terracut::scan {

/// How far points lie above or below their ring's line (vertical distance, metres).
struct HeightResidual {
  std::size_t points = 0;
  double rms_m = 0;
  double median_m = 0;
  double p95_m = 0;  ///< 95 % of the points are nearer to the line.
};

/// A unit's ring table found in its recordings, and how well it explains them.
struct FittedRings {
  RingTable table;
  HeightResidual residual;  ///< Residual over all rings.
  std::vector<HeightResidual> by_ring;
  /// True if no scan had all rings, so that a nominal table told them apart.
  bool from_nominal_table = false;
  /// Number of rings with a line of their own whose points are no lower than those of the ring
  /// above.
  std::size_t coinciding = 0;
  std::size_t with_line = 0;  ///< Rings with a fitted line; the others are interpolated.
};

/// Finds elevation and vertical offset of every ring of a unit from scans whose rings are known.
///
/// The points of one laser lie on a line over horizontal distance. Ranging noise moves them along
/// it; motion compensation moves them beside it, horizontally by up to decimetres. So the line is
/// fitted with an error in both coordinates (Deming), mostly in the distance, and robustly (Cauchy
/// weights, iterated); otherwise the steep rings come out too flat by degrees.
///
/// Memory: at most kPointsPerRing points a ring are kept, evenly spaced over everything added.
/// Start-up code: allocates, not thread-safe. Deterministic.
class RingTableFit {
 public:
  static constexpr std::size_t kPointsPerRing = 60000;
  static constexpr std::size_t kMinPointsPerRing = 100;
  static constexpr std::size_t kMinPointsPerSeenRing = 10;
  /// Points beyond the sensor's reach are no returns; one of them would outweigh a whole ring.
  static constexpr float kReach_m = 150;

  explicit RingTableFit(int rings = kScanRings) : rings_(static_cast<std::size_t>(rings)) {}

  /// Adds a scan. `ring_of_point` has a ring from 0, or kNoRing, for each point. Points beyond
  /// kReach_m and points that are not finite are left out.
  void add(std::span<const ScanPoint> points, std::span<const std::int16_t> ring_of_point);

  /// Returns the table of everything added so far. Rings that saw only near ground, as in a cropped
  /// view, cannot tell elevation from vertical offset: with `offsets`, the vertical offsets are
  /// taken from there and only elevations are fitted (medians). Fails with kMalformed if fewer than
  /// half of the rings have enough points.
  [[nodiscard]] Expected<FittedRings> fit(const RingTable* offsets = nullptr) const;

  /// Returns the table when some rings have seen little or nothing, as those above the horizon of
  /// an open field, or most rings of a narrow view. A ring with ten points is fitted. Fails with
  /// kMalformed if fewer than four rings have these, or if the rings hold less than half of the
  /// points.
  [[nodiscard]] Expected<FittedRings> fit_seen(const RingTable& offsets) const;

 private:
  struct Sample {
    float distance_m, z_m;
  };
  struct Ring {
    std::vector<Sample> samples;
    std::size_t seen = 0;
    std::size_t stride = 1;  ///< Every stride-th point is kept.
  };

  using Lines = std::vector<std::optional<RingLine>>;

  [[nodiscard]] FittedRings table_of(Lines lines) const;
  [[nodiscard]] static RingLine through(const Ring& ring, double vert_offset_m);
  [[nodiscard]] static HeightResidual residual(const RingLine& line, const Ring& ring,
                                               std::vector<double>& all);

  std::vector<Ring> rings_;
};

}  // namespace terracut::scan
