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

void done(stage::StageObserver* observer, stage::Stage stage) noexcept TERRACUT_NONBLOCKING {
  if (observer != nullptr) observer->stage_done(stage);
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
      made_(made),
      is_current_(memory.take<std::uint8_t>("coarse stages",
                                            static_cast<std::size_t>(map_.grid().sectors()))) {}

void CoarseStages::begin(const frame::RangeImage& image) noexcept {
  assert((image.measured() != nullptr) == (made_ != nullptr));
  image_ = &image;
  generation_ = image.generation();
  labelled_ = 0;
  std::ranges::fill(is_current_, std::uint8_t{0});
  map_.reset();
  if (made_ != nullptr) made_->begin(image);
}

void CoarseStages::take_to(int end, const frame::RangeImage& image) noexcept {
  if (made_ != nullptr) {
    made_->make_until(map_.grid().columns_of({0, end}).end, image,
                      [this](int column, float z_m, float ground_range_m) noexcept {
                        map_.take_extra(column, z_m, ground_range_m);
                      });
  }
  map_.take_to(end, image, points_of(image));
}

void CoarseStages::advance(const frame::RangeImage& image, int complete_columns,
                           stage::CellPlanes& planes, stage::StageObserver* observer,
                           int most_blocks) noexcept {
  if (image.returns() == 0) return;  // a stream's first frame has an empty predecessor
  if (!has_begun(image)) begin(image);
  const elevation::RingGrid& grid = map_.grid();
  for (int block = 0; block < most_blocks; ++block) {
    const int size = sectors_of_block(grid.sectors() - map_.taken());
    const int end = map_.taken() + size;
    if (end > grid.sectors() || grid.columns_of({0, end}).end > complete_columns) return;
    if (observer != nullptr) observer->resumed();
    take_to(end, image);
    // The first sectors wait for the last ones: ground is interpolated across the seam.
    const elevation::RingGrid::Sectors next{std::max(labelled_, map_.reach()),
                                            map_.taken() - map_.reach()};
    if (next.end - next.begin < size) {
      done(observer, stage::Stage::kElevationMap);
      continue;
    }
    map_.finalize(next);
    label(next, image, planes, observer);
  }
}

void CoarseStages::finish(const frame::RangeImage& image, stage::CellPlanes& planes,
                          stage::StageObserver* observer) noexcept {
  const int sectors = map_.grid().sectors();
  if (observer != nullptr) observer->resumed();
  if (!has_begun(image)) begin(image);
  take_to(sectors, image);
  if (!map_.saw_all_of(image)) {
    begin(image);
    take_to(sectors, image);
  }
  map_.finalize_rest(is_current_);
  const int labelled_ahead = labelled_;
  if (labelled_ < sectors) label({labelled_, sectors}, image, planes, observer);
  label_changed(labelled_ahead, image, planes);
  if (uses_adjacent_points() && adjacent_.reach() > 0) {
    adjacent_.compare_across_seam(points_of(image), planes);
    adjacent_.mark({0, adjacent_.reach()}, planes);
    adjacent_.mark({shape_.columns - adjacent_.reach(), shape_.columns}, planes);
  }
  done(observer, stage::Stage::kAdjacentPoints);
  image_ = nullptr;
}

void CoarseStages::label(elevation::RingGrid::Sectors sectors, const frame::RangeImage& image,
                         stage::CellPlanes& planes, stage::StageObserver* observer) noexcept {
  const frame::ColumnRange columns = map_.grid().columns_of(sectors);
  map_.label(points_of(image), columns, planes);
  done(observer, stage::Stage::kElevationMap);
  if (uses_adjacent_points()) {
    adjacent_.reset(columns, planes);
    adjacent_.compare(points_of(image), columns, planes);
    adjacent_.mark({std::max(columns.begin - adjacent_.reach(), 0), columns.end}, planes);
    done(observer, stage::Stage::kAdjacentPoints);
  }
  labelled_ = sectors.end;
  for (int sector = sectors.begin; sector < sectors.end; ++sector) {
    is_current_[static_cast<std::size_t>(sector)] = 1;
  }
}

void CoarseStages::label_changed(int end, const frame::RangeImage& image,
                                 stage::CellPlanes& planes) noexcept {
  const auto has_changed = [&](int sector) {
    return sector < end && is_current_[static_cast<std::size_t>(sector)] == 0;
  };
  for (int sector = 0; sector < end; ++sector) {
    const int first = sector;
    while (has_changed(sector)) ++sector;
    if (sector > first) label_again({first, sector}, image, planes);
  }
}

void CoarseStages::label_again(elevation::RingGrid::Sectors sectors, const frame::RangeImage& image,
                               stage::CellPlanes& planes) noexcept {
  // Columns next to changed ones were compared with old heights, so they are reset as well.
  const auto widened = [this](frame::ColumnRange columns) {
    return frame::ColumnRange{std::max(columns.begin - adjacent_.reach(), 0),
                              std::min(columns.end + adjacent_.reach(), shape_.columns)};
  };
  const frame::ColumnRange changed = map_.grid().columns_of(sectors);
  if (!uses_adjacent_points()) {
    map_.label(points_of(image), changed, planes);
    return;
  }
  const frame::ColumnRange columns = widened(changed);
  map_.label(points_of(image), columns, planes);
  adjacent_.reset(columns, planes);
  adjacent_.compare(points_of(image), {columns.begin, widened(columns).end}, planes);
  adjacent_.mark(columns, planes);
}

}  // namespace terracut::ground
