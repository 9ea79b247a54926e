// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "assumptions.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "pipeline/elevation/ring_grid.hpp"
#include "pipeline/elevation/row_opening.hpp"
#include "pipeline/ground/profile.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::detection {

/// Ranges of an obstacle's front from the sensor's axis, metres.
struct Ranges {
  double from_m = 0, to_m = 0;
};

/// Computes the least height from which an upright box is always found, from the sensor's beams and
/// the method's thresholds. docs/reference/detection.md has the assumptions and the reasons.
///
/// A box is found if at least one return in every image column whose beams all meet its front is
/// labelled obstacle, and if there are at least two such columns. Higher boxes are always found;
/// lower ones often are.
class DetectionBound {
 public:
  /// `profile` is of a level mount and has shape.rows rings.
  DetectionBound(const ground::SegmenterConfig& config, const mount::RingProfile& profile,
                 frame::ImageShape shape, const Assumptions& assumptions);

  /// Returns for each width the least height, in whole centimetres, from which every box of that
  /// width is found whose front is in these ranges; none if no height up to kMostHeight_m is
  /// promised.
  [[nodiscard]] std::vector<std::optional<double>> least_heights_m(
      Ranges ranges, std::span<const double> widths_m) const;

  static constexpr double kMostHeight_m = 1.5;

 private:
  /// A row's beam: its height above the mount's plane at a distance d from the axis is start_m +
  /// rise * d.
  struct Beam {
    double start_m, rise;
    std::vector<std::size_t> rows_below;  ///< Rows that AdjacentPoints compares with this one.
  };
  /// The least and the greatest height above the foot of a front.
  struct Heights {
    double low_m, high_m;
  };
  /// A box's front at a range, and the slope of the ground along the line of sight, each known to
  /// within a half step.
  struct Front {
    double range_m, half_m, slope, half_slope;
    std::vector<Heights> rows{};  ///< Where the rows' beams meet the front.
    [[nodiscard]] double least_slope() const noexcept { return slope - half_slope; }
  };
  /// What the elevation map may take for ground at a front.
  struct Ground {
    std::size_t lowest_row = 0;  ///< The lowest row that surely meets the front.
    double surface_m = 0;        ///< Greatest height of the surface above the foot, without a top.
    double most_top_m = 0;       ///< A box's top higher than this is no ground.
  };

  void find_rows(Front& front) const;
  [[nodiscard]] std::optional<double> least_height_m(const Front& front, const Ground& ground,
                                                     double width_m) const;
  /// Returns nothing if the trace may lose the ground before the front or no row meets the front.
  [[nodiscard]] std::optional<Ground> ground_at(const Front& front) const;
  /// Returns the nearest and the farthest range at which a row meets the ground, infinity if none.
  [[nodiscard]] Ranges ground_ranges(std::size_t row, const Front& front) const;
  /// Returns the rises that GroundSurface may accept of a step into a band.
  [[nodiscard]] double most_step_up_m(double run_m, double unseen_m) const;
  [[nodiscard]] double most_passable_m(double run_m) const;
  [[nodiscard]] bool is_traced(const Front& front, double before_m) const;
  [[nodiscard]] bool has_steep_step(std::size_t row, const Front& front) const;
  [[nodiscard]] bool stands_out(std::size_t row, const Front& front, double width_m) const;
  /// Returns the greatest slope across the line of sight.
  [[nodiscard]] double across_slope(const Front& front) const;
  [[nodiscard]] int band_of(double range_m) const {
    return grid_.band_of(static_cast<float>(range_m));
  }
  [[nodiscard]] double unseen_m(int band) const { return double{grid_.unseen_m(band)}; }

  ground::SegmenterConfig config_;
  Assumptions assumptions_;
  memory::FixedMemory memory_;
  elevation::RingGrid grid_;
  elevation::RowOpening opening_;
  double column_rad_, sector_rad_;
  int fewest_columns_;       // of a sector
  std::vector<Beam> beams_;  // by row
};

}  // namespace terracut::detection
