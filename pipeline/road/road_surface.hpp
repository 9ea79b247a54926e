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

/// Finds the road surface: ground that the vehicle can reach without crossing a kerb or an edge,
/// and without leaving smooth ground. Not in the paper.
///
/// An edge is where the ground rises or falls along a ring more steeply than the terrain at large.
/// Edges, rough ground (grass) and obstacles are barriers; ground farther from all barriers than
/// half the vehicle's width is clear. The road is reached from the track ahead of and behind the
/// vehicle, over clear ground that is level with its neighbours, from ring to ring and along the
/// rings; a gap in a kerb that is too narrow for the vehicle leads nowhere. Finally the surface
/// grows from clear ground back to the barriers.
class RoadSurface {
 public:
  struct Config {
    bool enabled = false;  ///< False: all ground is kGround, which saves time.
    float vehicle_width_m = 2.0F;
    float track_m = 12.0F;         ///< Length of the track ahead and behind, as wide as the car.
    int edge_neighbours = 3;       ///< Edges and rough patches with fewer around them are noise.
    float max_step_m = 0.025F;     ///< A step up to this from ring to ring is level.
    float max_step_slope = 0.08F;  ///< A slope up to this against the terrain is level, too.
    float max_gap_m = 4.0F;        ///< Rings farther apart are not connected.
    GroundPatches::Config patches;
    RingEdges::Config edges;
    TerrainSlope::Config terrain;  ///< max_roughness_m also limits the road's roughness.
  };

  RoadSurface(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory);

  /// Sets the ground returns in `labels` (one per return, by return index) that are not on the road
  /// surface to kOtherGround; `planes` has the labels of the cells. Real-time safe.
  void mark(const frame::RangeImage& image, const stage::CellPlanes& planes,
            std::span<frame::Label> labels) noexcept TERRACUT_NONBLOCKING;

 private:
  /// The state of a patch. Most patches go through the states in this order.
  enum class State : std::uint8_t {
    kEmpty,    // no return that matters here
    kBarrier,  // an edge, rough ground, or an obstacle
    kGround,   // smooth, but the vehicle's middle would be too near a barrier
    kClear,    // far enough from all barriers
    kGrown,    // added when the surface was grown back to the barriers
    kReached,  // clear and connected to the track
  };

  void find_barriers() noexcept;
  /// Removes barriers at patch numbers where an edge runs through the sensor.
  void open_seams() noexcept;
  void drop_lone_barriers() noexcept;
  void measure_along_rings() noexcept;
  /// Measures the distance from a barrier to the patches up to the next barrier on the ring.
  void measure_from(int row, int index, int step) noexcept;
  void find_clear() noexcept;
  void begin_blocking() noexcept;
  /// Blocks patches that are too near to barriers of earlier rows; call it row by row.
  void block_row(int row) noexcept;
  void reach_from_track() noexcept;
  void visit(std::size_t from, int row, int index) noexcept;
  void grow_back() noexcept;
  /// Grows from one patch to the next if that path is the shortest so far. Returns true if it was.
  bool grow(std::size_t from, std::size_t to, float limit_m) noexcept {
    const bool is_open = state_[to] >= State::kGround && state_[to] <= State::kGrown;
    return is_open && grow_far(from, to, limit_m);  // seldom taken, so only the test is inline
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
  std::span<std::uint8_t> is_barrier_;  // by patch of a row, and kAround more across the seam
  std::span<std::uint8_t> around_;      // barriers within kAround patches before and after
  std::span<std::uint8_t> neighbours_;  // by patch of a row: barriers in nearby rows
  std::span<std::uint8_t> is_active_;   // by patch of a row: to be processed; see for_each()
  std::span<float> distance_m_;         // to a barrier on the ring, later to reached ground
  std::span<float> blocked_;            // above 0 where another ring's barrier is too near
  std::span<float> from_m_, to_m_;      // by column: ranges blocked by earlier barriers
  std::span<Place> to_visit_;           // a stack that every patch enters at most once
  std::size_t visits_ = 0;
};

}  // namespace terracut::road
