// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/frame_points.hpp"
#include "firmware_io/frame/frame_returns.hpp"
#include "firmware_io/frame/point_planes.hpp"
#include "pipeline/elevation/adjacent_points.hpp"
#include "pipeline/elevation/ring_elevation_map.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ground {

/// The coarse stages of the method: elevation map and adjacent points. Most of the work can be done
/// while the frame is arriving, on columns just written and still in the core's caches:
///
///   columns   0 ......................................................... all
///             | later |  labelled  |  taken: their lowest returns known |  to come  |
///                 |                '-- a sector's ground depends on the 15 sectors that follow
///                 '-- labelled at the end: their ground depends on the last columns, too
///
/// The labels are bit for bit the same as if the whole frame had come at once, in whatever order
/// packets came and whatever was labelled ahead.
///
/// All memory is taken in the constructor. One thread at a time; real-time safe if the observer is.
class CoarseStages {
 public:
  /// `profile` must have shape.rows rings. `made` computes points of decoded frames, and is null
  /// for clouds: advance() computes the columns it needs, finish() all.
  CoarseStages(const SegmenterConfig& config, const mount::RingProfile& profile,
               frame::ImageShape shape, memory::FixedMemory& memory,
               frame::FramePoints* made = nullptr);

  /// Does part of the work on a frame that is still arriving: labels columns in blocks, at most
  /// `most_blocks` per call. Columns [0, complete_columns) of `frame` must be complete and stay
  /// unchanged. The labels go to `planes`, which belong to this frame until finish(). Another
  /// frame drops the work done for the previous one.
  void advance(const frame::FrameReturns& frame, int complete_columns, stage::CellPlanes& planes,
               stage::StageObserver* observer = nullptr,
               int most_blocks = kAnyNumber) noexcept TERRACUT_NONBLOCKING;
  /// Returns the share of a frame's sectors, [0, 1], that are already labelled before finish().
  [[nodiscard]] float share_ahead(const frame::FrameReturns& frame) const noexcept
      TERRACUT_NONBLOCKING {
    if (!has_begun(frame)) return 0;
    return static_cast<float>(labelled_ - map_.settled().begin) /
           static_cast<float>(map_.grid().sectors());
  }

  /// Completes a whole frame: fills `height_m`, `label` and, if adjacent points are among the
  /// stages, `steep` of every cell.
  void finish(const frame::FrameReturns& frame, stage::CellPlanes& planes,
              stage::StageObserver* observer = nullptr) noexcept TERRACUT_NONBLOCKING;

 private:
  static constexpr int kAnyNumber = std::numeric_limits<int>::max();

  void begin(const frame::FrameReturns& frame) noexcept;
  void done(stage::Stage stage) noexcept;
  void take_to(int end, const frame::FrameReturns& frame) noexcept;
  [[nodiscard]] frame::PointPlanes points_of(const frame::FrameReturns& frame) const noexcept {
    return made_ != nullptr ? made_->planes() : frame.image()->points();
  }
  [[nodiscard]] bool has_begun(const frame::FrameReturns& frame) const noexcept {
    return begun_ == frame.identity();
  }
  /// Labels the sectors that are settled and not labelled yet.
  void label_settled(const frame::FrameReturns& frame, stage::CellPlanes& planes) noexcept;
  void label(elevation::RingGrid::Sectors sectors, const frame::FrameReturns& frame,
             stage::CellPlanes& planes) noexcept;
  /// Compares the columns labelled first with those labelled last, on either side of `column`.
  void compare_across(int column, const frame::FrameReturns& frame,
                      stage::CellPlanes& planes) noexcept;
  /// Returns the first column that is labelled.
  [[nodiscard]] int first_column() const noexcept {
    const int sector = map_.grid().wrapped(map_.settled().begin);
    return map_.grid().columns_of({sector, sector + 1}).begin;
  }
  [[nodiscard]] bool uses_adjacent_points() const noexcept {
    return last_stage_ >= stage::Stage::kAdjacentPoints;
  }

  stage::Stage last_stage_;
  frame::ImageShape shape_;
  elevation::RingElevationMap map_;
  elevation::AdjacentPoints adjacent_;
  frame::FramePoints* made_;
  frame::FrameReturns::Identity begun_;  // the frame being labelled
  stage::StageObserver* observer_ = nullptr;
  int labelled_ = 0;  // the next sector to label, among RingElevationMap::settled()
};

}  // namespace terracut::ground
