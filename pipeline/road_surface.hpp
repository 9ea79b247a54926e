// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "pipeline/cell_planes.hpp"
#include "pipeline/ground_patches.hpp"
#include "pipeline/label.hpp"
#include "pipeline/range_image.hpp"
#include "pipeline/terrain_slope.hpp"
#include "rt/fixed_memory.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::pipeline {

/// The road surface: ground the vehicle can get to without crossing a kerb or an edge, and without
/// leaving smooth ground. Not in the paper.
///
/// An edge is where the ground rises or falls along a ring steeper than the terrain at large does.
/// Edges, rough ground (grass) and obstacles bar the way; what is farther from them than half the
/// vehicle's width is clear. From the track ahead of and behind the vehicle everything clear is
/// reached that lies level with what was reached before, ring to ring and along the rings; a hole
/// in a kerb too narrow for the vehicle leads nowhere. At last the surface is grown back from what
/// is clear to what bars it.
class RoadSurface {
 public:
  struct Config {
    bool enabled = false;  ///< It costs time; without it all ground is kGround.
    float vehicle_width_m = 2.0F;
    float track_m = 12.0F;       ///< The way begins so far ahead and behind, on its own width.
    float edge_width_m = 0.40F;  ///< Heights are compared over this length of a ring ...
    float edge_slope = 0.06F;    ///< ... where more than this against the terrain is an edge ...
    float edge_bend = 0.04F;     ///< ... if neither side of it is nearly as steep.
    int edge_neighbours = 3;  ///< Edges and rough patches with fewer in the rows around are noise.
    float max_step_m = 0.025F;     ///< From ring to ring: always level up to here ...
    float max_step_slope = 0.08F;  ///< ... and up to this slope against the terrain.
    float max_gap_m = 4.0F;        ///< Rings farther apart are not connected.
    GroundPatches::Config patches;
    TerrainSlope::Config terrain;  ///< Its max_roughness_m is that of a road.
  };

  RoadSurface(const Config& config, ImageShape shape, rt::FixedMemory& memory);

  /// Makes kOtherGround of the ground returns in `labels` (one a return, by return index) that are
  /// not on the road surface; `planes` holds the labels of their cells. Real-time safe.
  void mark(const RangeImage& image, const CellPlanes& planes,
            std::span<Label> labels) noexcept TERRACUT_NONBLOCKING;

 private:
  /// What a patch is, in the order it becomes it.
  enum class State : std::uint8_t {
    kEmpty,    // no return that matters
    kBarrier,  // an edge, rough, or with an obstacle
    kGround,   // smooth, but too near to a barrier for the vehicle's middle
    kClear,    // far enough from all barriers
    kReached,  // clear, and there is a way
  };

  void find_barriers() noexcept;
  /// Patches of a row, the first and the last; may lie beyond the seam.
  struct Run {
    int first, last;
  };
  /// Whether the ground rises or falls across a patch along the ring.
  [[nodiscard]] bool is_edge(int row, int index) const noexcept;
  /// Rise over run, against the terrain where the patch `index` lies, from the patches of one run
  /// to those of another, as far as they are ground about as far away as that patch; NaN if none
  /// are.
  [[nodiscard]] float slope_between(int row, int index, Run left, Run right) const noexcept;
  void drop_lone_barriers() noexcept;
  void measure_along_rings() noexcept;
  void find_clear() noexcept;
  /// Takes away what lies too near to the barrier of a patch's ring, in the rings above or below.
  void block_around(int row, int index, int step) noexcept;
  void reach_from_track() noexcept;
  void visit(std::size_t from, std::size_t to) noexcept;
  void grow_back() noexcept;
  /// Goes from a patch that was grown to, to the next, if that is nearer than any way before.
  bool grow(std::size_t from, std::size_t to, float limit_m) noexcept;
  [[nodiscard]] bool level(const GroundPatches::Patch& from,
                           const GroundPatches::Patch& to) const noexcept;
  [[nodiscard]] std::size_t at(int row, int index) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(ground_.per_row()) +
           static_cast<std::size_t>(index);
  }

  Config config_;
  GroundPatches ground_;
  TerrainSlope terrain_;
  std::span<State> state_;
  std::span<std::uint8_t> is_lone_;    // barriers to be dropped
  std::span<float> distance_m_;        // first to a barrier on the ring, then to what was reached
  std::span<std::uint32_t> to_visit_;  // a stack; every patch enters it once at most
  std::size_t visits_ = 0;
};

}  // namespace terracut::pipeline
