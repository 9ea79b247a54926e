// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "baseline.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "savitzky_golay.hpp"

namespace terracut::baselines {

/// The range image method of Bogoslavskyi and Stachniss ("Efficient online segmentation for sparse
/// 3D laser scans", PFG 85, 2017). For each return it computes the inclination of the line to the
/// return above it in its column, smoothed along the column. Ground is what can be reached from the
/// lowest returns by steps to one of four neighbours, if that angle changes little in each step.
/// The method knows no ground height: `height_m` is 0 where the label is ground, else the height
/// above the mount's ground plane. Reports kAdjacentPoints and kLabels.
class ColumnAngles final : public Baseline {
 public:
  struct Config {
    float start_deg = 45.0F;       ///< Ground starts at angles up to this, (0, 90].
    float same_ground_deg = 5.0F;  ///< A step on ground changes the angle by less, (0, 90].
    int smoothing_window = 5;      ///< Rows of the Savitzky-Golay filter, odd, [1, 15].
    int repair_rows = 5;           ///< Most rows to a return that bridges a hole, [0, 32].
    float repair_range_m = 1.0F;   ///< Largest difference of the ranges bridged, [0, 100].
    int margin_rows = 0;           ///< Rows by which ground grows up and down at the end, [0, 16].
  };

  /// Takes all memory. `profile` is not used: the angles are measured.
  ColumnAngles(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
               std::size_t return_capacity, memory::FixedMemory& memory);

  /// Returns the smoothed angle of each cell, degrees in [0, 90] (smoothing may overshoot); NaN for
  /// a cell with neither a return nor a repaired hole.
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
  std::span<float> range_m_, z_m_;  // of the repaired image, NaN for no return
  std::span<float> raw_deg_, angle_deg_;
  std::span<std::uint8_t> ground_;  // by cell: 1 if reached from the lowest returns
  std::span<std::uint32_t> queue_;  // of the breadth-first search
};

}  // namespace terracut::baselines
