// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/elevation/adjacent_points.hpp"
#include "pipeline/elevation/ring_elevation_map.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ground {

/// The coarse stages of the method, elevation map and adjacent points, on a circle of columns. The
/// circle is one turn closed with itself, or turn after turn, each in place of the one before:
///
///   columns of a turn   0 ........................................................... all
///                       |  labelled  |  taken: their lowest returns known |  to come  |
///                                    '-- a sector's ground depends on the 13 sectors that follow
///
/// All memory is taken in the constructor. One thread at a time; real-time safe if the observer is.
class CoarseStages {
 public:
  /// `profile` must have shape.rows rings.
  CoarseStages(const SegmenterConfig& config, const mount::RingProfile& profile,
               frame::ImageShape shape, memory::FixedMemory& memory);

  /// Forgets all turns and begins one.
  void begin() noexcept TERRACUT_NONBLOCKING;
  /// Begins the turn that follows a labelled one. Columns labelled are counted from its beginning.
  void begin_next_turn() noexcept TERRACUT_NONBLOCKING;

  /// Takes a return that owns no cell.
  void take_extra(int column, float z_m, float ground_range_m) noexcept TERRACUT_NONBLOCKING {
    map_.take_extra(column, z_m, ground_range_m);
  }
  /// Takes the turn's columns before this sector, which must be complete.
  void take_to(int sector, const frame::PointPlanes& points,
               stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;
  /// Labels what can be labelled of turns that follow a labelled one: fills `height_m`, `label`
  /// and, if adjacent points are among the stages, `steep`.
  void label(const frame::PointPlanes& points, stage::CellPlanes& planes,
             stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;
  /// Labels the columns before this sector, which must be taken, without waiting for what follows
  /// them: that is seen as it was a turn before. All of a turn labelled so is a circle.
  void label_until(int sector, const frame::PointPlanes& points, stage::CellPlanes& planes,
                   stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;
  void label_circle(const frame::PointPlanes& points, stage::CellPlanes& planes,
                    stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING {
    label_until(grid().sectors(), points, planes, observer);
  }

  [[nodiscard]] int taken_sectors() const noexcept { return map_.taken(); }
  /// The turn's columns before this one have their final labels; below 0 if some of the turn before
  /// it have not.
  [[nodiscard]] int labelled_columns() const noexcept TERRACUT_NONBLOCKING;
  /// Returns how high a return of a labelled column lies above the ground.
  [[nodiscard]] float height_of(int column, float z_m, float ground_range_m) const noexcept {
    return map_.height_of(column, z_m, ground_range_m);
  }
  /// Returns the sectors, and by that the columns, in which turns are taken.
  [[nodiscard]] const elevation::RingGrid& grid() const noexcept { return map_.grid(); }
  /// True if turns can follow each other: the circle is wide enough.
  [[nodiscard]] bool can_go_on() const noexcept { return map_.can_go_on(); }

 private:
  void label_settled(const frame::PointPlanes& points, stage::CellPlanes& planes,
                     stage::StageObserver* observer) noexcept;
  void label_sectors(elevation::RingGrid::Sectors sectors, const frame::PointPlanes& points,
                     stage::CellPlanes& planes, stage::StageObserver* observer) noexcept;
  void find_steep(frame::ColumnRange columns, const frame::PointPlanes& points,
                  stage::CellPlanes& planes) noexcept;
  [[nodiscard]] bool uses_adjacent_points() const noexcept {
    return last_stage_ >= stage::Stage::kAdjacentPoints;
  }

  stage::Stage last_stage_;
  frame::ImageShape shape_;
  elevation::RingElevationMap map_;
  elevation::AdjacentPoints adjacent_;
  int labelled_ = 0;  // sectors before this one are labelled
};

}  // namespace terracut::ground
