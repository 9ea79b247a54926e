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

/// Finds kerbs and other edges of the ground: places where it rises or falls along a ring more
/// steeply than the terrain at large, unless the ring goes on as steeply to one side (a bank).
class RingEdges {
 public:
  struct Config {
    float width_m = 0.60F;  ///< Length of a ring over which heights are compared.
    float slope = 0.06F;    ///< Least slope of an edge against the terrain.
    float bend = 0.04F;     ///< An edge is steeper than either side by this.
  };

  /// Makes room for patches like those of `ground`.
  RingEdges(const Config& config, const GroundPatches& ground, memory::FixedMemory& memory);

  /// To be called before the rows of a frame. Real-time safe.
  void begin_frame() noexcept TERRACUT_NONBLOCKING;
  /// Returns 1 for each patch of a row with an edge across it; meaningless for patches without
  /// ground. Valid until the next call. Real-time safe.
  [[nodiscard]] std::span<const std::uint8_t> find(const GroundPatches& ground,
                                                   const TerrainSlope& terrain,
                                                   int row) noexcept TERRACUT_NONBLOCKING;
  /// True if an edge goes up, or down, at this patch number in most rings of the frame, near and
  /// far. The seam of a compensated frame does: its last returns were measured at another place
  /// than its first. A kerb does only if it leads from under the vehicle to 20 m away; then it
  /// blocks nothing.
  [[nodiscard]] bool runs_through_sensor(int index) const noexcept TERRACUT_NONBLOCKING;

 private:
  /// The first and the last patch of a run in a row; may lie beyond the seam.
  struct Run {
    int first, last;
  };
  /// Fills the planes of a row and their margins; false if the row has no ground.
  bool take_row(const GroundPatches& ground, const TerrainSlope& terrain,
                std::size_t first) noexcept;
  /// Removes the edges whose windows lie on both sides of the frame's seam.
  void reset_at_seam(const GroundPatches& ground, std::size_t first) noexcept;
  void count_steps(int per_row) noexcept;
  void find_slopes_across(int per_row) noexcept;
  /// True if the ring is about as steep to either side of a patch as across it.
  [[nodiscard]] bool goes_on_beside(const GroundPatches& ground, int index) const noexcept;
  /// Returns rise over run, relative to the terrain at the patch `index`, between the patches of
  /// two runs; uses only ground at about that patch's range. NaN if there is none.
  [[nodiscard]] float slope_between(int index, Run left, Run right) const noexcept;

  /// Patches beyond both ends of a row that windows reach.
  static constexpr int kMargin = 2 * GroundPatches::kMostPatchesOver;
  [[nodiscard]] static std::size_t padded(int index) noexcept {
    return static_cast<std::size_t>(index + kMargin);
  }

  Config config_;
  float most_range_m_;  // beyond it patches are longer than an edge is wide
  // Counts over the rows so far, by patch number:
  std::span<float> rings_;          // rows with ground on both sides
  std::span<float> rises_, falls_;  // rows that rise there, or fall, more than beside it
  // For the row in work, with the margin on both sides:
  std::span<float> x_m_, y_m_, z_m_;
  std::span<float> range_m_;  // kNoGround_m without ground
  // For the row in work, without the margin:
  std::array<std::span<float>, 16> sums_;  // of windows: x, y, z, count; left, right, their means
  std::span<TerrainSlope::Gradient> terrain_;
  std::span<float> slope_;         // across each patch
  std::span<std::int32_t> reach_;  // half of width_m, in patches
  std::span<std::uint8_t> is_edge_;
};

}  // namespace terracut::road
