// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/ring_profile.hpp"
#include "pipeline/cell_planes.hpp"
#include "pipeline/range_image.hpp"
#include "rt/fixed_memory.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::pipeline {

/// How two returns, one above the other, are told to be too steep for ground.
enum class AdjacentRule : std::uint8_t {
  /// Horizontal distance below the bound of Eq. 5, which assumes the lower return on the mount's
  /// plane: Algorithm 1 as printed.
  kRingSpacing,
  /// Measured rise over measured run: the same test without the assumption of a plane.
  kSlope,
};

/// Stage 2: spatiotemporal adjacent points (paper, section III-C, Eq. 3-5, Algorithm 1). Compares
/// every return with those of the next rows up in its own and the neighbouring columns, and calls
/// the upper one (kSlope: both) an obstacle where the step between them is too steep for ground.
class AdjacentPoints {
 public:
  struct Config {
    AdjacentRule rule = AdjacentRule::kSlope;
    float max_slope_rad = 0.60F;  ///< K: the steepest ground, (0, pi/2).
    int first_row_step = 1;      ///< Row steps up from .. to; the paper compares l with l + 2 only.
    int last_row_step = 2;       ///< [first_row_step, 4]
    float row_step_deg = 0.25F;  ///< A row step covers at least this elevation (RowSteps), [0, 5].
    int column_reach = 1;        ///< Columns to each side; "colselzoo" in Algorithm 1; [0, 8].
    float min_rise_m = 0.10F;    ///< kSlope: smaller rises are noise.
    float min_upper_height_m =
        0.04F;  ///< kSlope: the upper return must be this far above the ground reference.
    float min_lower_height_m = 0.05F;  ///< kSlope: above this the lower return is marked as well.
  };

  AdjacentPoints(const Config& config, const calib::RingProfile& profile, ImageShape shape,
                 rt::FixedMemory& memory);

  /// Fills `steep` and turns the label of steep returns to kObstacle. Real-time safe.
  void refine(const RangeImage& image, CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;

  /// Bound of Eq. 5 for the pair of `row` and the row `row_step` steps up, metres; 0 (no bound)
  /// where the upper beam never reaches the ground.
  [[nodiscard]] float ring_spacing_m(int row, int row_step) const noexcept;

 private:
  struct RowPair {
    std::size_t lower;  // first cell of the rows
    std::size_t upper;
    int column_offset;  // of the upper column from the lower one
    float bound_m;      // Eq. 5
  };
  void mark(const RangeImage& image, const RowPair& pair, CellPlanes& planes) const noexcept;

  Config config_;
  ImageShape shape_;
  float tan_max_slope_squared_;
  std::span<float> ring_spacing_m_;      // [row_step - 1][row]
  std::span<std::int32_t> upper_row_;    // likewise: the row that is so many steps up
  std::span<std::uint8_t> steep_pairs_;  // of the pair of rows at hand, by column
};

}  // namespace terracut::pipeline
