// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "baseline.hpp"
#include "belief_propagation.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::baselines {

/// Models the ground as a multi-label Markov random field, after Zhang, Morris and Fu ("Ground
/// segmentation based on loopy belief propagation for sparse 3D point clouds", 3DV 2015): each cell
/// of a polar map gets one ground height from a list. A column's returns give each height a cost,
/// without an assumed distribution. Two neighbours cost more the more their heights differ beyond a
/// possible slope, up to a limit that allows steps. Belief propagation solves the field; a return
/// is ground if it is not far above its cell's height. Its sources and what they
/// leave open are in docs/decisions/0037-the-papers-baselines.md. Reports kElevationMap when the
/// costs are set, kMinCut when the field is solved, and kLabels.
class HeightFieldMrf final : public Baseline {
 public:
  struct Config {
    int sectors = 180;            ///< Sectors of the polar map, [3, 2000].
    float band_m = 1.0F;          ///< Width of its rings, [0.2, 20].
    float range_limit_m = 80.0F;  ///< Farther returns count to the last ring, [10, 250].
    int height_labels = 64;       ///< Number of heights to choose from, [2, 128].
    float height_step_m = 0.1F;   ///< Spacing of these heights; [0.01, 1].

    float above_cost = 0.5F;   ///< Cost if all returns of a column are above, [0, 1000].
    float below_cost = 5.0F;   ///< Cost if all returns of a column are below, [0, 1000].
    float beside_cost = 0.1F;  ///< Cost if all are one step off, [0, 1000].
    int full_returns = 5;      ///< Columns of fewer returns count less, [1, 1000].
    float hidden_cost = 2.0F;  ///< Cost of ground where a beam passed, [0, 1000].

    float step_cost_per_m = 10.0F;  ///< Cost of a difference beyond a slope, [0, 1000].
    float step_cost_limit = 1.0F;   ///< Upper limit of that cost, [0, 1000].
    float max_slope = 0.15F;        ///< Slope without cost, m/m; [0, 2].
    int iterations = 20;            ///< [0, 1000]

    float obstacle_height_m = 0.2F;  ///< Obstacles are this far above the ground, (0, 5].
  };

  /// Takes all memory. Uses only the mount's height of `profile`.
  HeightFieldMrf(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
                 std::size_t return_capacity, memory::FixedMemory& memory);

  /// Returns the ground's height at an image column and a range, metres above the mount's plane.
  [[nodiscard]] float ground_m(int column, float ground_range_m) const noexcept {
    return height_of(field_.label(band_of(ground_range_m), sector_of(column)));
  }

 private:
  void label_cells(const frame::RangeImage& image,
                   stage::StageObserver* observer) noexcept override;
  void put_labels(const frame::RangeImage& image) noexcept;
  [[nodiscard]] int band_of(float ground_range_m) const noexcept;
  [[nodiscard]] int sector_of(int column) const noexcept {
    return sector_of_column_[static_cast<std::size_t>(column)];
  }
  [[nodiscard]] std::size_t map_cell(int band, int sector) const noexcept {
    return static_cast<std::size_t>(band) * static_cast<std::size_t>(config_.sectors) +
           static_cast<std::size_t>(sector);
  }
  [[nodiscard]] int label_of(float height_m) const noexcept;
  [[nodiscard]] float height_of(int label) const noexcept;
  void count_returns(const frame::RangeImage& image) noexcept;
  void put_costs() noexcept;
  void put_cost(int band, int sector, float free_above_m) noexcept;
  void put_slopes() noexcept;

  Config config_;
  frame::ImageShape shape_;
  float sensor_height_m_;
  int bands_;
  BeliefPropagation field_;              // rows: bands, columns: sectors
  std::span<std::uint16_t> returns_at_;  // [map cell][height label]
  std::span<float> least_slope_;         // by map cell: the least slope of beams that end in it
  std::span<std::uint16_t> sector_of_column_;
};

}  // namespace terracut::baselines
