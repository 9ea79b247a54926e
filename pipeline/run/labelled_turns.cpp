// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/run/labelled_turns.hpp"

#include <utility>

namespace terracut::run {

void LabelledTurns::end_stream() noexcept {
  decoder_.end_stream();
  closes_ = true;
}

const frame::Frame* LabelledTurns::next(const min_cut::CutBudget& budget,
                                        stage::StageObserver* observer) noexcept {
  if (std::exchange(is_handed_out_, false)) method_->release();
  for (;;) {
    if (const frame::Frame* const turn = labelled()) return turn;
    if (const frame::Frame* const turn = decoder_.next()) {
      (whole_[0].returns == nullptr ? whole_[0] : whole_[1]) = *turn;
      method_->end_turn(*turn->returns, budget, observer);
      continue;
    }
    const frame::ArrivingFrame arriving = decoder_.arriving();
    if (arriving.returns != nullptr) {
      method_->advance(*arriving.returns, arriving.complete_columns, budget, observer);
      if (const frame::Frame* const turn = labelled()) return turn;
    }
    if (!std::exchange(closes_, false)) return nullptr;
    method_->close(budget, observer);
  }
}

const frame::Frame* LabelledTurns::labelled() noexcept {
  if (method_->labelled() == nullptr) return nullptr;
  turn_ = std::exchange(whole_[0], std::exchange(whole_[1], {}));
  is_handed_out_ = true;
  return &turn_;
}

}  // namespace terracut::run
