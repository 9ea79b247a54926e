// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/cell_planes.hpp"
#include "pipeline/range_image.hpp"
#include "rt/fixed_memory.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::pipeline {

/// Short pieces of rings: a few columns of one row, with what their ground returns have in common.
/// Heights along a ring come from one laser, so they are exact to millimetres where those of
/// different lasers are not; a piece is short enough for a kerb to lie between two of them.
///
/// Patches are numbered row by row, `per_row()` each; columns close to a circle. The last patch of
/// a row may be shorter.
class GroundPatches {
 public:
  struct Config {
    float width_deg = 1.0F;            ///< Azimuth a patch covers, to the nearest whole column.
    float clearance_height_m = 2.0F;   ///< Obstacles higher above the ground are no obstacles here.
    float roughness_window_m = 0.50F;  ///< Roughness is a mean so far to either side.
  };

  /// What a patch tells. Metres in the vehicle frame, means over the ground returns of the patch.
  struct Patch {
    float x_m = 0, y_m = 0, z_m = 0;
    float range_m = 0;      ///< Horizontal; without ground that of the nearest obstacle.
    float roughness_m = 0;  ///< Mean departure of a return's height from the middle of its two
                            ///< neighbours' on the ring, over roughness_window_m. 0 where unknown.
    bool has_ground = false;
    bool has_obstacle = false;  ///< One that stands lower than clearance_height_m.
  };

  GroundPatches(const Config& config, ImageShape shape, rt::FixedMemory& memory);

  /// Takes the patches of a labelled image. Real-time safe.
  void collect(const RangeImage& image, const CellPlanes& planes) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] int rows() const noexcept { return shape_.rows; }
  [[nodiscard]] int per_row() const noexcept { return per_row_; }
  [[nodiscard]] std::span<const Patch> patches() const noexcept { return patches_; }
  [[nodiscard]] int columns_per_patch() const noexcept { return columns_per_patch_; }
  /// Number of a patch along its row; the row goes on beyond both its ends.
  [[nodiscard]] int wrapped(int index) const noexcept {
    while (index < 0) index += per_row_;
    while (index >= per_row_) index -= per_row_;
    return index;
  }
  /// From one patch of a ring to the next, metres.
  [[nodiscard]] float spacing_m(float range_m) const noexcept { return range_m * spacing_rad_; }
  static constexpr int kMostPatchesOver = 8;  ///< Bounds windows near the sensor, and the work.
  /// How many patches of a ring it takes to cover `length_m`, to the nearest; at least 1, at most
  /// kMostPatchesOver.
  [[nodiscard]] int patches_over(float length_m, float range_m) const noexcept TERRACUT_NONBLOCKING;

 private:
  /// Sums over the returns of a row's patches up to one, of those whose neighbours on the ring are
  /// ground as they are.
  struct Bends {
    float sum_m = 0;
    float count = 0;
  };

  void collect_row(const RangeImage& image, const CellPlanes& planes, int row) noexcept;
  void sum_bends() noexcept;
  void smooth_roughness(int row) noexcept;

  Config config_;
  ImageShape shape_;
  int columns_per_patch_;
  int per_row_;
  float spacing_rad_;
  std::span<Patch> patches_;
  // Of the row in work:
  std::span<float> bend_m_;          // by column, 0 where there is none
  std::span<std::uint8_t> is_bend_;  // by column
  std::span<Bends> bends_before_;    // by patch, from kMostPatchesOver before the row's first one
};

}  // namespace terracut::pipeline
