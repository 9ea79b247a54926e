// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/stream_segmenter.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "pipeline/ground/closed_turns.hpp"
#include "pipeline/ground/segmenter.hpp"

namespace terracut::ground {

StreamSegmenter::StreamSegmenter(const SegmenterConfig& config, Pace pace,
                                 const mount::RingProfile& profile, frame::ImageShape shape,
                                 std::size_t return_capacity,
                                 std::unique_ptr<frame::TileReader> reader,
                                 memory::FixedMemory& memory)
    : shape_(shape),
      least_sectors_(pace == Pace::kLatency ? 4 : kMostSectors),
      last_stage_(config.last_stage),
      below_m_(config.ghost_limit_m()),
      planes_(shape, memory),
      points_(shape, std::move(reader), memory),
      coarse_(config, profile, shape, memory),
      fine_(config, profile, shape, memory),
      return_labels_(config.returns, config.elevation_map.obstacle_height_m, return_capacity,
                     memory) {
  if (config.gives_heights) return_heights_.emplace(return_capacity, memory);
}

void StreamSegmenter::advance(const frame::MeasuredReturns& turn, int complete_columns,
                              const min_cut::CutBudget& budget,
                              stage::StageObserver* observer) noexcept {
  if (turn.returns() == 0) return;  // it may come to nothing
  const elevation::RingGrid& grid = coarse_.grid();
  begin_if_new(turn, budget, observer);
  const int complete =
      complete_columns == shape_.columns ? grid.sectors() : grid.sector_of(complete_columns);
  while (complete - coarse_.taken_sectors() >= least_sectors_) {
    take_to(std::min(coarse_.taken_sectors() + kMostSectors, complete), turn, budget, observer);
  }
}

void StreamSegmenter::end_turn(const frame::MeasuredReturns& turn, const min_cut::CutBudget& budget,
                               stage::StageObserver* observer) noexcept {
  begin_if_new(turn, budget, observer);
  const int sectors = coarse_.grid().sectors();
  while (coarse_.taken_sectors() < sectors) {
    take_to(std::min(coarse_.taken_sectors() + kMostSectors, sectors), turn, budget, observer);
  }
  is_whole_ = true;
  if (!is_circle_) return label_returns(observer);
  coarse_.label_circle(points_.planes(), planes_, observer);
  fine_.label_circle(points_.planes(), planes_, budget, observer);
  label_returns(observer);
}

void StreamSegmenter::close(const min_cut::CutBudget& budget,
                            stage::StageObserver* observer) noexcept {
  if (!has_begun_ || (is_circle_ && !is_whole_)) return;
  stage::resumed(observer);
  // Of a turn that still comes, nothing is labelled before its time.
  const int sector = is_whole_ ? coarse_.grid().sectors() : 0;
  coarse_.label_until(sector, points_.planes(), planes_, observer);
  fine_.label_until(coarse_.grid().columns_of({0, sector}).end, points_.planes(), planes_, budget,
                    observer);
  label_returns(observer);
}

void StreamSegmenter::release() noexcept {
  labelled_ = nullptr;
  report_ = {};
  label_returns(nullptr);
}

void StreamSegmenter::begin_if_new(const frame::MeasuredReturns& turn,
                                   const min_cut::CutBudget& budget,
                                   stage::StageObserver* observer) noexcept {
  if (has_begun_ && turn.turn() == newest_) return;
  assert(!has_begun_ || is_whole_);
  is_circle_ = !has_begun_ || turn.turn() != newest_ + 1 || !can_go_on();
  if (is_circle_) {
    close(budget, observer);
    coarse_.begin();
    fine_.begin();
  } else {
    coarse_.begin_next_turn();
    fine_.begin_next_turn();
  }
  assert(unlabelled_[1] == nullptr);
  (unlabelled_[0] == nullptr ? unlabelled_[0] : unlabelled_[1]) = &turn;
  newest_ = turn.turn();
  has_begun_ = true;
  is_whole_ = false;
  points_.begin_turn();
}

void StreamSegmenter::take_to(int sector, const frame::MeasuredReturns& turn,
                              const min_cut::CutBudget& budget,
                              stage::StageObserver* observer) noexcept {
  stage::resumed(observer);
  points_.make_until(coarse_.grid().columns_of({0, sector}).end, turn,
                     [this](int column, float z_m, float ground_range_m) noexcept {
                       coarse_.take_extra(column, z_m, ground_range_m);
                     });
  coarse_.take_to(sector, points_.planes(), observer);
  if (is_circle_) return;
  coarse_.label(points_.planes(), planes_, observer);
  fine_.label_to(coarse_.labelled_columns(), points_.planes(), planes_, budget, observer);
  label_returns(observer);
}

void StreamSegmenter::label_returns(stage::StageObserver* observer) noexcept {
  if (labelled_ != nullptr || unlabelled_[0] == nullptr) return;
  const frame::MeasuredReturns& turn = *unlabelled_[0];
  const bool is_newest = unlabelled_[1] == nullptr && turn.turn() == newest_;
  const int end = fine_.labelled_columns() + (is_newest ? 0 : shape_.columns);
  const auto height_of = [this](int column, float z_m, float ground_range_m) noexcept {
    return coarse_.height_of(column, z_m, ground_range_m);
  };
  if (next_tile_ == 0) return_labels_.begin();
  if (next_tile_ == 0 && return_heights_) return_heights_->begin();
  for (; next_tile_ < turn.tiles() && turn.tile(next_tile_).most < end; ++next_tile_) {
    report_.late += return_labels_.assign_tile(turn, next_tile_, points_.planes(), points_.reader(),
                                               planes_, height_of);
    if (!return_heights_) continue;
    return_heights_->assign_tile(turn, next_tile_, points_.reader(), planes_, height_of);
  }
  count_to(std::clamp(end, 0, shape_.columns));
  const bool is_whole = !is_newest || is_whole_;
  if (is_whole && next_tile_ == turn.tiles() && end >= shape_.columns) {
    report_.count(return_labels_.labels());
    report_.cut = fine_.take_report();
    report_.last_stage = report_.cut.discarded ? stage::Stage::kAdjacentPoints : last_stage_;
    labelled_ = &turn;
    unlabelled_ = {unlabelled_[1], nullptr};
    next_tile_ = 0;
    counted_columns_ = 0;
  }
  stage::done(stage::Stage::kLabels, observer);
}

void StreamSegmenter::count_to(int end) noexcept {
  if (end <= counted_columns_) return;
  if (near_ground_ != nullptr) {
    if (counted_columns_ == 0) near_ground_->count = 0;
    add_near_ground(points_.planes(), {counted_columns_, end}, shape_, *near_ground_);
  }
  const auto count = static_cast<std::size_t>(end - counted_columns_);
  for (int row = 0; row < shape_.rows; ++row) {
    report_.below += stage::count_below(
        planes_.height_m.subspan(shape_.cell(row, counted_columns_), count), below_m_);
  }
  counted_columns_ = end;
}

TurnMethodMaker turn_maker_of(const SegmenterConfig& config, Pace pace) {
  if (config.road.enabled) return closed_turns_of(maker_of(config));
  return [config, pace](FramesToCome turns, memory::FixedMemory& memory) {
    return std::make_unique<StreamSegmenter>(config, pace, turns.profile, turns.shape,
                                             turns.return_capacity, std::move(turns.reader),
                                             memory);
  };
}

}  // namespace terracut::ground
