// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tests/simulation/cached_method.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <utility>

namespace terracut::simulation {
namespace {

constexpr int kColumnsAhead = 130;  ///< What a sector looks ahead (docs/design.md).

}  // namespace

CachedMethod::CachedMethod(const ground::FramesToCome& turns, memory::FixedMemory& memory)
    : labels_(memory.take<frame::Label>("cached labels", turns.return_capacity)) {}

void CachedMethod::advance(const frame::MeasuredReturns& turn, int complete_columns,
                           const min_cut::CutBudget& budget,
                           stage::StageObserver* observer) noexcept {
  if (turn.returns() == 0) return;  // it may come to nothing
  begin_if_new(turn, budget, observer);
  if (labelled_ != nullptr) return;
  if (turns_[0] == &turn) {
    label_to(complete_columns - kColumnsAhead, budget, observer);
  } else if (complete_columns >= kColumnsAhead) {
    finish(budget, observer);
  }
}

void CachedMethod::end_turn(const frame::MeasuredReturns& turn, const min_cut::CutBudget& budget,
                            stage::StageObserver* observer) noexcept {
  begin_if_new(turn, budget, observer);
  const bool is_oldest = turns_[0] == &turn;
  is_whole_[is_oldest ? 0 : 1] = true;
  if (!is_oldest && labelled_ == nullptr) finish(budget, observer);
}

void CachedMethod::close(const min_cut::CutBudget& budget,
                         stage::StageObserver* observer) noexcept {
  if (labelled_ == nullptr && is_whole_[0]) finish(budget, observer);
}

void CachedMethod::release() noexcept {
  labelled_ = nullptr;
  turns_ = {turns_[1], nullptr};
  is_whole_ = {is_whole_[1], false};
  known_ = next_tile_ = 0;
  report_ = {};
}

void CachedMethod::begin_if_new(const frame::MeasuredReturns& turn,
                                const min_cut::CutBudget& budget,
                                stage::StageObserver* observer) noexcept {
  if (turns_[0] == nullptr) turns_[0] = &turn;
  if (turns_[0] == &turn || turns_[1] == &turn) return;
  turns_[1] = &turn;
  const bool follows = turn.turn() == turns_[0]->turn() + 1;
  if (!follows && labelled_ == nullptr) finish(budget, observer);
}

void CachedMethod::finish(const min_cut::CutBudget& budget,
                          stage::StageObserver* observer) noexcept {
  label_to(std::numeric_limits<int>::max(), budget, observer);
  report_.count(labels_.first(known_));
  labelled_ = turns_[0];
}

void CachedMethod::label_to(int column, const min_cut::CutBudget& budget,
                            stage::StageObserver* observer) noexcept {
  const frame::MeasuredReturns& turn = *turns_[0];
  if (observer != nullptr) observer->resumed();
  for (; next_tile_ < turn.tiles() && turn.tile(next_tile_).most < column; ++next_tile_) {
    label_tile(turn, next_tile_, !min_cut::OpClock(budget).expired());
  }
  if (observer != nullptr) observer->stage_done(stage::Stage::kMinCut);
}

void CachedMethod::label_tile(const frame::MeasuredReturns& turn, std::size_t tile,
                              bool in_time) noexcept {
  const std::uint16_t* const raw = turn.raw(tile);
  for (std::size_t firing = 0; firing < frame::kTileFirings; ++firing) {
    for (std::size_t laser = 0; laser < turn.lasers(); ++laser) {
      if ((turn.row(tile, laser).returns >> firing & 1) == 0) continue;
      const bool is_ground = (raw[laser * frame::kTileFirings + firing] * 0x9E37U >> 11 & 1) == 0;
      labels_[known_++] = is_ground && in_time ? frame::Label::kGround : frame::Label::kObstacle;
      report_.cut.coarse_by_budget += in_time ? 0 : 1;
    }
  }
}

ground::TurnMethodMaker cached_method() {
  return [](const ground::FramesToCome& turns, memory::FixedMemory& memory) {
    return std::make_unique<CachedMethod>(turns, memory);
  };
}

}  // namespace terracut::simulation
