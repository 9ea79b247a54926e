// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/range_image.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::road {

/// Short pieces of rings, called patches: a few columns of one row, with the means of their ground
/// returns. Heights along a ring are exact to millimetres, as they come from one laser. A patch is
/// so short that a kerb lies between two patches.
///
/// Patches are numbered row by row, `per_row()` each, cyclic in columns. The last patch of a row
/// may be shorter.
class GroundPatches {
 public:
  struct Config {
    float width_deg = 1.0F;            ///< Azimuth of a patch, to the nearest whole column.
    float clearance_height_m = 2.0F;   ///< Higher obstacles are ignored.
    float roughness_window_m = 0.50F;  ///< Roughness is averaged this far to each side.
  };

  GroundPatches(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory);

  /// Computes the patches of a labelled image. Real-time safe.
  void collect(const frame::RangeImage& image,
               const stage::CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] int rows() const noexcept { return shape_.rows; }
  [[nodiscard]] int per_row() const noexcept { return per_row_; }
  /// The following functions return one value per patch. These three are the mean position of the
  /// patch's ground returns, metres in the vehicle frame; 0 if the patch has no ground.
  [[nodiscard]] std::span<const float> x_m() const noexcept { return x_m_; }
  [[nodiscard]] std::span<const float> y_m() const noexcept { return y_m_; }
  [[nodiscard]] std::span<const float> z_m() const noexcept { return z_m_; }
  /// Returns the horizontal range of each patch: that of its ground, else of its nearest obstacle,
  /// else NaN.
  [[nodiscard]] std::span<const float> range_m() const noexcept { return range_m_; }
  /// Returns how much the height of a return differs on average from the mean of its two neighbours
  /// on the ring, over roughness_window_m. 0 if unknown.
  [[nodiscard]] std::span<const float> roughness_m() const noexcept { return roughness_m_; }
  [[nodiscard]] std::span<const std::uint8_t> has_ground() const noexcept { return has_ground_; }
  /// Returns 1 for patches with an obstacle below clearance_height_m, else 0.
  [[nodiscard]] std::span<const std::uint8_t> has_obstacle() const noexcept {
    return has_obstacle_;
  }
  /// Returns 1 where the last returns of a ring meet its first ones, inside the patch or between it
  /// and the next. The vehicle moved in between, so heights do not match there.
  [[nodiscard]] std::span<const std::uint8_t> is_seam() const noexcept { return is_seam_; }
  [[nodiscard]] int columns_per_patch() const noexcept { return columns_per_patch_; }
  /// Maps a patch number beyond either end of its row to a valid number.
  [[nodiscard]] int wrapped(int index) const noexcept {
    while (index < 0) index += per_row_;
    while (index >= per_row_) index -= per_row_;
    return index;
  }
  /// after() and before() return the number of the adjacent patch, across a row's end, too.
  [[nodiscard]] int after(int index) const noexcept { return index + 1 < per_row_ ? index + 1 : 0; }
  [[nodiscard]] int before(int index) const noexcept {
    return index > 0 ? index - 1 : per_row_ - 1;
  }
  /// Returns the distance from one patch of a ring to the next, metres.
  [[nodiscard]] float spacing_m(float range_m) const noexcept { return range_m * spacing_rad_; }
  static constexpr int kMostPatchesOver = 8;  ///< Bounds windows near the sensor.
  /// Returns how many patches of a ring cover `length_m`, rounded; at least 1, at most
  /// kMostPatchesOver.
  [[nodiscard]] int patches_over(float length_m, float range_m) const noexcept TERRACUT_NONBLOCKING;
  /// Does the same as patches_over() for all patches of a row.
  void count_patches_over(float length_m, std::size_t row,
                          std::span<std::int32_t> patches) const noexcept TERRACUT_NONBLOCKING;

  /// Sums over the returns whose neighbours on the ring are both ground.
  struct Bends {
    float sum_m = 0;
    float count = 0;
  };

 private:
  /// Finds the seam in a row and resets the bends there. The frame has `returns` returns.
  void find_seam(std::size_t row, std::uint32_t returns) noexcept;
  void smooth_roughness(std::size_t row) noexcept;

  Config config_;
  frame::ImageShape shape_;
  int columns_per_patch_;
  int per_row_;
  float spacing_rad_;
  std::span<float> x_m_, y_m_, z_m_, range_m_, roughness_m_;
  std::span<std::uint8_t> has_ground_, has_obstacle_, is_seam_;
  // Work space for one row:
  std::span<std::uint8_t> is_ground_, is_bend_;  // by column
  std::span<float> bend_m_, low_m_;              // by column, see find_bends() and find_low()
  std::span<Bends> bends_;                       // by patch; kMostPatchesOver more on both sides
  std::span<Bends> bends_before_;                // running sums of bends_ before each patch
  std::span<std::uint32_t> arrival_;  // by patch: arrival index of its first ground return
  std::span<std::int32_t> reach_;     // by patch: half its window, in patches
};

}  // namespace terracut::road
