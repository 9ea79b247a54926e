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

/// Kerbs and other edges of the ground: where it rises or falls along a ring steeper than the
/// terrain at large does, unless the ring goes on like that to one side (a bank).
class RingEdges {
 public:
  struct Config {
    float width_m = 0.60F;  ///< Heights are compared over this length of a ring ...
    float slope = 0.06F;    ///< ... where more than this against the terrain is an edge ...
    float bend = 0.04F;     ///< ... if neither side of it is nearly as steep.
  };

  /// For patches like those of `ground`.
  RingEdges(const Config& config, const GroundPatches& ground, memory::FixedMemory& memory);

  /// To be called before the rows of a frame. Real-time safe.
  void begin_frame() noexcept TERRACUT_NONBLOCKING;
  /// 1 for each patch of a row across which there is an edge. Of patches without ground it says
  /// nothing. What it returns lasts until the next call. Real-time safe.
  [[nodiscard]] std::span<const std::uint8_t> find(const GroundPatches& ground,
                                                   const TerrainSlope& terrain,
                                                   int row) noexcept TERRACUT_NONBLOCKING;
  /// Whether an edge goes up, or down, at this number of a patch in most rings of the frame, near
  /// and far. No kerb does that but one that leads from under the vehicle to 20 m away, and that
  /// bars no way. What does is the seam of a frame compensated for the vehicle's motion: its last
  /// returns lie on the circles of another place than its first.
  [[nodiscard]] bool runs_through_sensor(int index) const noexcept TERRACUT_NONBLOCKING;

 private:
  /// Patches of a row, the first and the last; may lie beyond the seam.
  struct Run {
    int first, last;
  };
  /// Makes the planes of a row with their margins; false if there is no ground in it.
  bool take_row(const GroundPatches& ground, const TerrainSlope& terrain,
                std::size_t first) noexcept;
  /// Takes back the edges whose windows lie on both sides of the frame's seam.
  void reset_at_seam(const GroundPatches& ground, std::size_t first) noexcept;
  void count_steps(int per_row) noexcept;
  void find_slopes_across(int per_row) noexcept;
  /// Whether the ring is about as steep to either side of a patch as across it.
  [[nodiscard]] bool goes_on_beside(const GroundPatches& ground, int index) const noexcept;
  /// Rise over run, against the terrain where the patch `index` lies, from the patches of one run
  /// to those of another, as far as they are ground about as far away as that patch; NaN if none
  /// are.
  [[nodiscard]] float slope_between(int index, Run left, Run right) const noexcept;

  /// Patches beyond both ends of a row that its windows reach.
  static constexpr int kMargin = 2 * GroundPatches::kMostPatchesOver;
  [[nodiscard]] static std::size_t padded(int index) noexcept {
    return static_cast<std::size_t>(index + kMargin);
  }

  Config config_;
  float most_range_m_;  // beyond it patches are longer than an edge is wide
  // Of the rows found so far, by number of a patch, how many ...
  std::span<float> rings_;          // have ground to both sides of it
  std::span<float> rises_, falls_;  // and go up there, or down, more than beside it
  // Of the row in work, with the margin on both sides:
  std::span<float> x_m_, y_m_, z_m_;
  std::span<float> range_m_;  // far beyond everything where there is no ground
  // Without it:
  std::array<std::span<float>, 16> sums_;  // of windows: x, y, z, count; left, right, their means
  std::span<TerrainSlope::Gradient> terrain_;
  std::span<float> slope_;         // across each patch
  std::span<std::int32_t> reach_;  // how many patches half of width_m is
  std::span<std::uint8_t> is_edge_;
};

}  // namespace terracut::road
