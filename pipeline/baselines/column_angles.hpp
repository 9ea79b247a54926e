// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/baselines/baseline.hpp"
#include "pipeline/baselines/savitzky_golay.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::baselines {

/// The range image method of Bogoslavskyi and Stachniss ("Efficient online segmentation for sparse
/// 3D laser scans", PFG 85, 2017): the inclination of the line from each return to the one above it
/// in its column, smoothed along the column; ground is what can be reached from the lowest returns
/// by steps to one of four neighbours over which that angle changes little. It knows no height of
/// the ground: heights are 0 where the label is ground and above the mount's ground plane
/// elsewhere. Reports kAdjacentPoints and kLabels.
class ColumnAngles final : public Baseline {
 public:
  struct Config {
    float start_deg = 45.0F;       ///< Ground starts at no steeper angle, (0, 90].
    float same_ground_deg = 5.0F;  ///< A step between neighbours changes it by less, (0, 90].
    int smoothing_window = 5;      ///< Rows of the Savitzky-Golay filter, odd, [1, 15].
    int repair_rows = 5;           ///< A hole is bridged from no farther away, [0, 32] ...
    float repair_range_m = 1.0F;   ///< ... between ranges that differ by less, [0, 100].
    int margin_rows = 0;           ///< Ground grows so many rows up and down at the end, [0, 16].
  };

  /// `profile` is not looked at: the angles are measured. Takes all memory.
  ColumnAngles(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
               std::size_t return_capacity, memory::FixedMemory& memory);

  /// Smoothed angle by cell, degrees in [0, 90] but for what smoothing overshoots; NaN where
  /// neither a return nor a repaired hole is.
  [[nodiscard]] std::span<const float> angle_deg() const noexcept { return angle_deg_; }

 private:
  void label_cells(const frame::RangeImage& image,
                   stage::StageObserver* observer) noexcept override;
  void put_labels(const frame::RangeImage& image) noexcept;
  void repair_columns(const frame::RangeImage& image) noexcept;
  void bridge_hole(const frame::RangeImage& image, int row, int column) noexcept;
  void measure_angles() noexcept;
  void smooth_angles() noexcept;
  void spread_ground() noexcept;
  void spread_from(std::uint32_t start) noexcept;
  void grow_ground() noexcept;
  [[nodiscard]] std::size_t cell(int row, int column) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(shape_.stride()) +
           static_cast<std::size_t>(column);
  }

  Config config_;
  frame::ImageShape shape_;
  SavitzkyGolay filter_;
  std::span<float> range_m_, z_m_;  // of the repaired image, NaN where nothing is
  std::span<float> raw_deg_, angle_deg_;
  std::span<std::uint8_t> ground_;  // by cell: reached from the lowest returns
  std::span<std::uint32_t> queue_;  // of the breadth-first search
};

}  // namespace terracut::baselines
