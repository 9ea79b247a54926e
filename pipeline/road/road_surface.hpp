// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/road/ground_patches.hpp"
#include "pipeline/road/ring_edges.hpp"
#include "pipeline/road/terrain_slope.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::road {

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
    float track_m = 12.0F;    ///< The way begins so far ahead and behind, on its own width.
    int edge_neighbours = 3;  ///< Edges and rough patches with fewer in the rows around are noise.
    float max_step_m = 0.025F;     ///< From ring to ring: always level up to here ...
    float max_step_slope = 0.08F;  ///< ... and up to this slope against the terrain.
    float max_gap_m = 4.0F;        ///< Rings farther apart are not connected.
    GroundPatches::Config patches;
    RingEdges::Config edges;
    TerrainSlope::Config terrain;  ///< Its max_roughness_m is that of a road.
  };

  RoadSurface(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory);

  /// Makes kOtherGround of the ground returns in `labels` (one a return, by return index) that are
  /// not on the road surface; `planes` holds the labels of their cells. Real-time safe.
  void mark(const frame::RangeImage& image, const stage::CellPlanes& planes,
            std::span<frame::Label> labels) noexcept TERRACUT_NONBLOCKING;

 private:
  /// What a patch is, mostly in the order it becomes it.
  enum class State : std::uint8_t {
    kEmpty,    // no return that matters
    kBarrier,  // an edge, rough, or with an obstacle
    kGround,   // smooth, but too near to a barrier for the vehicle's middle
    kClear,    // far enough from all barriers
    kGrown,    // either, and grown back to
    kReached,  // clear, and there is a way
  };

  void find_barriers() noexcept;
  /// Takes back the barriers where an edge runs through the sensor.
  void open_seams() noexcept;
  void drop_lone_barriers() noexcept;
  void measure_along_rings() noexcept;
  /// To the patches between a barrier and the next one of its ring, as far as they matter.
  void measure_from(int row, int index, int step) noexcept;
  void find_clear() noexcept;
  void begin_blocking() noexcept;
  /// Blocks what lies too near to barriers of the rows before; to be called row by row.
  void block_row(int row) noexcept;
  void reach_from_track() noexcept;
  void visit(std::size_t from, int row, int index) noexcept;
  void grow_back() noexcept;
  /// Goes from a patch that was grown to, to the next, if that is nearer than any way before.
  bool grow(std::size_t from, std::size_t to, float limit_m) noexcept {
    const bool is_open = state_[to] >= State::kGround && state_[to] <= State::kGrown;
    return is_open && grow_far(from, to, limit_m);  // seldom, so only the question is inline
  }
  bool grow_far(std::size_t from, std::size_t to, float limit_m) noexcept;
  void mark_returns(const frame::RangeImage& image, const stage::CellPlanes& planes,
                    std::span<frame::Label> labels) const noexcept;
  [[nodiscard]] bool level(std::size_t from, std::size_t to) const noexcept;
  [[nodiscard]] std::size_t at(int row, int index) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(ground_.per_row()) +
           static_cast<std::size_t>(index);
  }

  struct Place {
    std::int32_t row, index;
  };

  Config config_;
  GroundPatches ground_;
  TerrainSlope terrain_;
  RingEdges edges_;
  std::span<State> state_;
  std::span<std::uint8_t> is_barrier_;  // of a row, and kAround on across the seam
  std::span<std::uint8_t> around_;      // barriers from kAround patches before to kAround after
  std::span<std::uint8_t> neighbours_;  // of a row, barriers in the rows around
  std::span<std::uint8_t> is_active_;   // of a row, where there is something to do; see for_each()
  std::span<float> distance_m_;         // first to a barrier on the ring, then to what was reached
  std::span<float> blocked_;            // more than 0 where a barrier of another ring is too near
  std::span<float> from_m_, to_m_;      // of each column, the ranges that barriers before block
  std::span<Place> to_visit_;           // a stack; every patch enters it once at most
  std::size_t visits_ = 0;
};

}  // namespace terracut::road
