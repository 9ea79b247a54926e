// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/coarse_stages.hpp"

#include <algorithm>

namespace terracut::ground {
CoarseStages::CoarseStages(const SegmenterConfig& config, const mount::RingProfile& profile,
                           frame::ImageShape shape, memory::FixedMemory& memory)
    : last_stage_(config.last_stage),
      shape_(shape),
      map_(config.elevation_map, profile, shape, memory),
      adjacent_(config.adjacent_points, config.elevation_map.obstacle_height_m, profile, shape,
                memory) {}

void CoarseStages::begin() noexcept {
  map_.begin();
  labelled_ = 0;
}

void CoarseStages::begin_next_turn() noexcept {
  map_.begin_next_turn();
  labelled_ -= grid().sectors();
}

void CoarseStages::take_to(int sector, const frame::PointPlanes& points,
                           stage::StageObserver* observer) noexcept {
  map_.take_to(sector, points);
  stage::done(stage::Stage::kElevationMap, observer);
}

void CoarseStages::label(const frame::PointPlanes& points, stage::CellPlanes& planes,
                         stage::StageObserver* observer) noexcept {
  map_.settle();
  label_settled(points, planes, observer);
}

void CoarseStages::label_until(int sector, const frame::PointPlanes& points,
                               stage::CellPlanes& planes, stage::StageObserver* observer) noexcept {
  map_.settle_until(sector);
  label_settled(points, planes, observer);
}

int CoarseStages::labelled_columns() const noexcept {
  const int column = labelled_ >= 0
                         ? grid().columns_of({0, labelled_}).end
                         : grid().columns_of({0, grid().wrapped(labelled_)}).end - shape_.columns;
  // A column is compared with those beside it.
  return uses_adjacent_points() ? column - adjacent_.reach() : column;
}

void CoarseStages::label_settled(const frame::PointPlanes& points, stage::CellPlanes& planes,
                                 stage::StageObserver* observer) noexcept {
  const int sectors = grid().sectors();
  while (labelled_ < map_.settled()) {
    const int first = grid().wrapped(labelled_);
    const int count = std::min(map_.settled() - labelled_, sectors - first);
    label_sectors({first, first + count}, points, planes, observer);
    labelled_ += count;
  }
}

void CoarseStages::label_sectors(elevation::RingGrid::Sectors sectors,
                                 const frame::PointPlanes& points, stage::CellPlanes& planes,
                                 stage::StageObserver* observer) noexcept {
  const frame::ColumnRange columns = grid().columns_of(sectors);
  map_.label(points, columns, planes);
  stage::done(stage::Stage::kElevationMap, observer);
  if (!uses_adjacent_points()) return;
  find_steep(columns, points, planes);
  stage::done(stage::Stage::kAdjacentPoints, observer);
}

void CoarseStages::find_steep(frame::ColumnRange columns, const frame::PointPlanes& points,
                              stage::CellPlanes& planes) noexcept {
  const int reach = adjacent_.reach();
  adjacent_.reset(columns, planes);
  adjacent_.compare(points, columns, planes);
  if (columns.begin == 0 && reach > 0) {
    adjacent_.compare_across_seam(points, planes);
    adjacent_.mark({shape_.columns - reach, shape_.columns}, planes);
  }
  adjacent_.mark({std::max(columns.begin - reach, 0), columns.end}, planes);
}

}  // namespace terracut::ground
