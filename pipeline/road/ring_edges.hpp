// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pipeline/road/ground_patches.hpp"
#include "pipeline/road/terrain_slope.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::road {

/// Finds kerbs and other edges of the ground: places where the ground rises or falls along a ring
/// more steeply than the terrain at large, unless one side of the place is as steep (a bank).
class RingEdges {
 public:
  struct Config {
    float width_m = 0.60F;  ///< Length of a ring over which heights are compared.
    float slope = 0.06F;    ///< Least slope of an edge, relative to the terrain.
    float bend = 0.04F;     ///< An edge is this much steeper than the ground on each side.
  };

  /// Takes memory for patches like those of `ground`.
  RingEdges(const Config& config, const GroundPatches& ground, memory::FixedMemory& memory);

  /// Begins a frame; call it before the frame's rows. Real-time safe.
  void begin_frame() noexcept TERRACUT_NONBLOCKING;
  /// Returns 1 for each patch of a row that an edge crosses; meaningless for patches without
  /// ground. Valid until the next call. Real-time safe.
  [[nodiscard]] std::span<const std::uint8_t> find(const GroundPatches& ground,
                                                   const TerrainSlope& terrain,
                                                   int row) noexcept TERRACUT_NONBLOCKING;
  /// True if an edge goes up (or down) at this patch number in most rings of the frame, near and
  /// far. The seam of a compensated frame looks like this, because its last returns were measured
  /// from another place than its first. A kerb does so only if it leads from under the vehicle to
  /// 20 m away; then it blocks nothing.
  [[nodiscard]] bool runs_through_sensor(int index) const noexcept TERRACUT_NONBLOCKING;

 private:
  /// The numbers of the first and the last patch of a run in a row; both may lie beyond the seam.
  struct Run {
    int first, last;
  };
  /// Fills the planes of a row and their margins; returns false if the row has no ground.
  bool take_row(const GroundPatches& ground, const TerrainSlope& terrain,
                std::size_t first) noexcept;
  /// Removes edges whose windows include both sides of the frame's seam.
  void reset_at_seam(const GroundPatches& ground, std::size_t first) noexcept;
  void count_steps(int per_row) noexcept;
  void find_slopes_across(int per_row) noexcept;
  /// True if on one side of a patch the ring is about as steep as across the patch.
  [[nodiscard]] bool goes_on_beside(const GroundPatches& ground, int index) const noexcept;
  /// Returns the slope (rise over run) between the patches of two runs, minus the terrain's slope
  /// at patch `index`; uses only ground at about that patch's range. NaN if there is no such
  /// ground.
  [[nodiscard]] float slope_between(int index, Run left, Run right) const noexcept;

  /// Number of patches beyond both ends of a row that windows can include.
  static constexpr int kMargin = 2 * GroundPatches::kMostPatchesOver;
  [[nodiscard]] static std::size_t padded(int index) noexcept {
    return static_cast<std::size_t>(index + kMargin);
  }

  Config config_;
  float most_range_m_;  // farther patches are longer than an edge is wide
  // Counts of rows so far, by patch number:
  std::span<float> rings_;          // rows with ground on both sides
  std::span<float> rises_, falls_;  // rows that rise or fall here more than beside it
  // Work space for one row, with the margin on both sides:
  std::span<float> x_m_, y_m_, z_m_;
  std::span<float> range_m_;  // kNoGround_m if there is no ground
  // Work space for one row, without the margin:
  std::array<std::span<float>, 16> sums_;  // window sums: x, y, z, count; left, right, means
  std::span<TerrainSlope::Gradient> terrain_;
  std::span<float> slope_;         // across each patch
  std::span<std::int32_t> reach_;  // half of width_m, in patches
  std::span<std::uint8_t> is_edge_;
};

}  // namespace terracut::road
