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

/// Finds the road surface: ground the vehicle can reach without crossing a kerb or an edge, and
/// without leaving smooth ground. Not in the paper.
///
/// An edge is where the ground rises or falls along a ring more steeply than the terrain at large.
/// Edges, rough ground (grass) and obstacles are barriers; ground farther from them than half the
/// vehicle's width is clear. From the track ahead of and behind the vehicle all clear ground is
/// reached that is level with its neighbours, ring to ring and along the rings; a gap in a kerb too
/// narrow for the vehicle leads nowhere. Finally the surface is grown back from clear ground to the
/// barriers.
class RoadSurface {
 public:
  struct Config {
    bool enabled = false;  ///< Costs time; without it all ground is kGround.
    float vehicle_width_m = 2.0F;
    float track_m = 12.0F;    ///< Starts so far ahead and behind, as wide as the vehicle.
    int edge_neighbours = 3;  ///< Edges and rough patches with fewer in the rows around are noise.
    float max_step_m = 0.025F;     ///< Level from ring to ring: any step up to here.
    float max_step_slope = 0.08F;  ///< Level, too: up to this slope against the terrain.
    float max_gap_m = 4.0F;        ///< Rings farther apart are not connected.
    GroundPatches::Config patches;
    RingEdges::Config edges;
    TerrainSlope::Config terrain;  ///< Its max_roughness_m also limits the road's roughness.
  };

  RoadSurface(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory);

  /// Sets the ground returns in `labels` (one a return, by return index) that are not on the road
  /// surface to kOtherGround; `planes` has the labels of their cells. Real-time safe.
  void mark(const frame::RangeImage& image, const stage::CellPlanes& planes,
            std::span<frame::Label> labels) noexcept TERRACUT_NONBLOCKING;

 private:
  /// The state of a patch; most are reached in this order.
  enum class State : std::uint8_t {
    kEmpty,    // no relevant return
    kBarrier,  // an edge, rough, or with an obstacle
    kGround,   // smooth, but too near a barrier for the vehicle's middle
    kClear,    // far enough from all barriers
    kGrown,    // kGround or kClear that was grown back to
    kReached,  // clear and connected to the track
  };

  void find_barriers() noexcept;
  /// Removes the barriers where an edge runs through the sensor.
  void open_seams() noexcept;
  void drop_lone_barriers() noexcept;
  void measure_along_rings() noexcept;
  /// Measures from a barrier to the relevant patches up to the next barrier on its ring.
  void measure_from(int row, int index, int step) noexcept;
  void find_clear() noexcept;
  void begin_blocking() noexcept;
  /// Blocks patches too near to barriers of earlier rows; to be called row by row.
  void block_row(int row) noexcept;
  void reach_from_track() noexcept;
  void visit(std::size_t from, int row, int index) noexcept;
  void grow_back() noexcept;
  /// Grows from one patch to the next if that path is the shortest so far.
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
  std::span<std::uint8_t> is_barrier_;  // of a row, with kAround more on across the seam
  std::span<std::uint8_t> around_;      // barriers from kAround patches before to kAround after
  std::span<std::uint8_t> neighbours_;  // by patch of a row: barriers in the rows around
  std::span<std::uint8_t> is_active_;   // of a row: patches to process; see for_each()
  std::span<float> distance_m_;         // first to a barrier on the ring, then to reached ground
  std::span<float> blocked_;            // more than 0 where a barrier of another ring is too near
  std::span<float> from_m_, to_m_;      // by column: the ranges that earlier barriers block
  std::span<Place> to_visit_;           // a stack; every patch enters it at most once
  std::size_t visits_ = 0;
};

}  // namespace terracut::road
