// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/free_way/sector.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::free_way {

/// Says for every direction where the nearest obstacle stands, and up to where the ground was seen.
///
/// **Obstacle**: the nearest return labelled obstacle that is at least `least_height_m` above the
/// ground and no higher than the vehicle needs (`clearance_m`). Heights are as good as the ground
/// before an obstacle is known: a return that is barely high enough may be the ground before a step
/// (both returns of a steep step are labelled). So it counts only if nothing higher stands close
/// behind it; if it is part of no steep step, but stands out of its row, it may be a little lower.
///
/// **Seen**: each image column is walked from its lowest row outwards, from ground return to ground
/// return. The walk goes on while the next ground return lies at most `max_gap_m` behind the last
/// one and not in a hole. So nothing between the first row and the end is longer than `max_gap_m`
/// and unseen: neither a hole, whose far wall is the next thing to return, nor water that mirrors
/// the beams away, nor what an obstacle hides, nor the ground between two rows. Where rows lie
/// farther apart than `max_gap_m`, the sensor cannot tell, and the walk ends (SeenEnd::kRows). Only
/// a single lost return between two columns that have the ground in that row is passed over.
///
/// A sector is as bad as the worst of its columns in both. Images must be as the sensor measured
/// them: in a deskewed one, returns of a column lie in other directions.
///
/// All memory is taken in the constructor; find() does not allocate, lock, throw or look at a
/// clock. The same image gives the same sectors on every machine. One thread at a time.
class FreeWay {
 public:
  struct Config {
    float sector_deg = 0.5F;       ///< Width of a sector, at least a column.
    float least_height_m = 0.06F;  ///< Returns lower than this above the ground are no obstacle.
    float clearance_m = 2.5F;      ///< Nor are returns higher than this.
    float max_gap_m = 0.9F;        ///< Most distance between two ground returns.
    float drop_m = 0.25F;          ///< A hole is deeper than this, unless the slope is gentle.
  };

  /// `profile` must have shape.rows rings.
  FreeWay(const Config& config, const mount::RingProfile& profile, frame::ImageShape shape,
          memory::FixedMemory& memory);

  /// Looks at an image of the shape given at construction. `planes` has the label of each cell and
  /// its height above the ground, `labels` the label of each return, by return index. Overwrites
  /// the last result. Real-time safe.
  void find(const frame::RangeImage& image, const stage::CellPlanes& planes,
            std::span<const frame::Label> labels) noexcept TERRACUT_NONBLOCKING;

  /// Returns the sectors, clockwise as columns are; the first begins straight ahead.
  [[nodiscard]] std::span<const Sector> sectors() const noexcept { return sectors_; }
  /// Returns the columns of a sector.
  [[nodiscard]] frame::ColumnRange columns_of(std::size_t sector) const noexcept {
    return {first_columns_[sector], first_columns_[sector + 1]};
  }
  /// Returns where the lowest row meets level ground: nearer ground is never seen.
  [[nodiscard]] float seen_from_m() const noexcept { return seen_from_m_; }

 private:
  /// How far the ground of a column was seen.
  struct Walk {
    float seen_m = 0;
    float height_m = 0;     ///< Of the ground there, above the mount's plane.
    bool is_open = true;    ///< It goes on.
    bool has_lost = false;  ///< A beam since then returned nothing.
    SeenEnd end = SeenEnd::kLost;
  };

  /// True if an obstacle return is surely high enough, and not too high.
  [[nodiscard]] bool is_in_the_way(float height_m) const noexcept {
    return height_m >= high_m_ && height_m <= config_.clearance_m;
  }
  void find_obstacles(const frame::RangeImage& image, const stage::CellPlanes& planes) noexcept;
  /// Takes notice of returns that do not own their cell.
  void find_second_obstacles(const frame::RangeImage& image, const stage::CellPlanes& planes,
                             std::span<const frame::Label> labels) noexcept;
  void walk(const frame::RangeImage& image, const stage::CellPlanes& planes) noexcept;
  /// Returns the number of columns that still go on.
  int walk_row(int row, const frame::RangeImage& image, const stage::CellPlanes& planes) noexcept;
  /// Returns the distance from which the next ground return must not lie too far.
  [[nodiscard]] float from_m(const Walk& walk) const noexcept;
  /// Goes to the ground at that distance and height, or ends before.
  void go_on(Walk& walk, float range_m, float height_m) const noexcept;
  void join_columns() noexcept;

  Config config_;
  frame::ImageShape shape_;
  int ground_rows_;  // rows that can meet the ground
  float seen_from_m_;
  float high_m_;                                  // returns at this height are surely high enough
  std::span<float> obstacle_m_, low_obstacle_m_;  // by column: surely high enough, or barely
  std::span<Walk> walks_;                         // by column
  std::span<int> first_columns_;                  // by sector, and the end of the last
  std::span<Sector> sectors_;
};

}  // namespace terracut::free_way
