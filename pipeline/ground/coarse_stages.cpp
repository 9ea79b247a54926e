// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/coarse_stages.hpp"

#include <algorithm>
#include <cassert>

namespace terracut::ground {
namespace {

/// Returns how many sectors to label together while the frame arrives: few enough to stay in the
/// caches next to the core, and fewer towards the frame's end, so that little is left to do then.
int sectors_of_block(int sectors_to_come) noexcept TERRACUT_NONBLOCKING {
  constexpr int kMost = 16, kLeast = 4;
  return std::clamp(sectors_to_come / 2, kLeast, kMost);
}

}  // namespace

CoarseStages::CoarseStages(const SegmenterConfig& config, const mount::RingProfile& profile,
                           frame::ImageShape shape, memory::FixedMemory& memory,
                           frame::FramePoints* made)
    : last_stage_(config.last_stage),
      shape_(shape),
      map_(config.elevation_map, profile, shape, memory),
      adjacent_(config.adjacent_points, config.elevation_map.obstacle_height_m, profile, shape,
                memory),
      made_(made) {}

void CoarseStages::begin(const frame::FrameReturns& frame) noexcept {
  assert((frame.measured() != nullptr) == (made_ != nullptr));
  begun_ = frame.identity();
  map_.reset();
  labelled_ = map_.settled().begin;
  if (made_ != nullptr) made_->begin(*frame.measured());
}

void CoarseStages::done(stage::Stage stage) noexcept {
  if (observer_ != nullptr) observer_->stage_done(stage);
}

void CoarseStages::take_to(int end, const frame::FrameReturns& frame) noexcept {
  if (made_ != nullptr) {
    made_->make_until(map_.grid().columns_of({0, end}).end, *frame.measured(),
                      [this](int column, float z_m, float ground_range_m) noexcept {
                        map_.take_extra(column, z_m, ground_range_m);
                      });
  }
  map_.take_to(end, frame, points_of(frame));
}

void CoarseStages::advance(const frame::FrameReturns& frame, int complete_columns,
                           stage::CellPlanes& planes, stage::StageObserver* observer,
                           int most_blocks) noexcept {
  if (frame.returns() == 0) return;  // a stream's first frame has an empty predecessor
  observer_ = observer;
  if (!has_begun(frame)) begin(frame);
  const elevation::RingGrid& grid = map_.grid();
  for (int block = 0; block < most_blocks; ++block) {
    const int end = map_.taken() + sectors_of_block(grid.sectors() - map_.taken());
    if (end > grid.sectors() || grid.columns_of({0, end}).end > complete_columns) return;
    if (observer != nullptr) observer->resumed();
    take_to(end, frame);
    done(stage::Stage::kElevationMap);
    label_settled(frame, planes);
  }
}

void CoarseStages::finish(const frame::FrameReturns& frame, stage::CellPlanes& planes,
                          stage::StageObserver* observer) noexcept {
  const int sectors = map_.grid().sectors();
  observer_ = observer;
  if (observer != nullptr) observer->resumed();
  if (!has_begun(frame)) begin(frame);
  take_to(sectors, frame);
  if (!map_.saw_all_of(frame)) {
    begin(frame);
    take_to(sectors, frame);
  }
  label_settled(frame, planes);
  if (uses_adjacent_points() && adjacent_.reach() > 0) {
    compare_across(0, frame, planes);
    if (first_column() != 0) compare_across(first_column(), frame, planes);
  }
  done(stage::Stage::kAdjacentPoints);
  begun_ = {};
}

void CoarseStages::label_settled(const frame::FrameReturns& frame,
                                 stage::CellPlanes& planes) noexcept {
  const int sectors = map_.grid().sectors();
  while (labelled_ < map_.settled().end) {
    const int first = map_.grid().wrapped(labelled_);
    const int count = std::min(map_.settled().end - labelled_, sectors - first);
    label({first, first + count}, frame, planes);
    labelled_ += count;
  }
}

void CoarseStages::label(elevation::RingGrid::Sectors sectors, const frame::FrameReturns& frame,
                         stage::CellPlanes& planes) noexcept {
  const frame::ColumnRange columns = map_.grid().columns_of(sectors);
  map_.label(points_of(frame), columns, planes);
  done(stage::Stage::kElevationMap);
  if (!uses_adjacent_points()) return;
  adjacent_.reset(columns, planes);
  const int leftmost = columns.begin >= first_column() ? first_column() : 0;
  adjacent_.compare(points_of(frame), columns, leftmost, planes);
  adjacent_.mark({std::max(columns.begin - adjacent_.reach(), leftmost), columns.end}, planes);
  done(stage::Stage::kAdjacentPoints);
}

void CoarseStages::compare_across(int column, const frame::FrameReturns& frame,
                                  stage::CellPlanes& planes) noexcept {
  adjacent_.compare_across(column, points_of(frame), planes);
  adjacent_.mark({column, column + adjacent_.reach()}, planes);
  const int end = column == 0 ? shape_.columns : column;
  adjacent_.mark({end - adjacent_.reach(), end}, planes);
}

}  // namespace terracut::ground
