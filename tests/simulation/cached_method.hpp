// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "pipeline/ground/turn_method.hpp"

namespace terracut::simulation {

/// Stands in for ground::StreamSegmenter where a hundred hours are to be simulated: gives labels in
/// the same order and as late, a turn's last ones with the first columns of the next, but each is
/// no more than a property of the return's distance. Where the budget's time is over, returns keep
/// another label and are counted, as cells that were not cut are.
class CachedMethod final : public ground::TurnMethod {
 public:
  CachedMethod(const ground::FramesToCome& turns, memory::FixedMemory& memory);

  void advance(const frame::MeasuredReturns& turn, int complete_columns,
               const min_cut::CutBudget& budget,
               stage::StageObserver* observer) noexcept TERRACUT_NONBLOCKING override;
  void end_turn(const frame::MeasuredReturns& turn, const min_cut::CutBudget& budget,
                stage::StageObserver* observer) noexcept TERRACUT_NONBLOCKING override;
  void close(const min_cut::CutBudget& budget,
             stage::StageObserver* observer) noexcept TERRACUT_NONBLOCKING override;
  [[nodiscard]] const frame::MeasuredReturns* labelled() const noexcept
      TERRACUT_NONBLOCKING override {
    return labelled_;
  }
  void release() noexcept TERRACUT_NONBLOCKING override;
  [[nodiscard]] const frame::MeasuredReturns* at_work() const noexcept
      TERRACUT_NONBLOCKING override {
    return next_tile_ > 0 ? turns_[0] : nullptr;
  }
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept
      TERRACUT_NONBLOCKING override {
    return labels_.first(known_);
  }
  void watch_near_ground(ground::NearGround* /*ground*/) noexcept TERRACUT_NONBLOCKING override {}
  [[nodiscard]] const stage::SegmentationReport& report() const noexcept
      TERRACUT_NONBLOCKING override {
    return report_;
  }

 private:
  /// Makes `turn` the newest. If it does not follow the one before, that one is labelled.
  void begin_if_new(const frame::MeasuredReturns& turn, const min_cut::CutBudget& budget,
                    stage::StageObserver* observer) noexcept;
  /// Labels the oldest turn's tiles that end before a column.
  void label_to(int column, const min_cut::CutBudget& budget,
                stage::StageObserver* observer) noexcept;
  void label_tile(const frame::MeasuredReturns& turn, std::size_t tile, bool in_time) noexcept;
  /// Labels the rest of the oldest turn, which is whole.
  void finish(const min_cut::CutBudget& budget, stage::StageObserver* observer) noexcept;

  std::span<frame::Label> labels_;
  std::size_t known_ = 0, next_tile_ = 0;
  std::array<const frame::MeasuredReturns*, 2> turns_{};  ///< Not released; the older one first.
  std::array<bool, 2> is_whole_{};
  const frame::MeasuredReturns* labelled_ = nullptr;
  stage::SegmentationReport report_;
};

[[nodiscard]] ground::TurnMethodMaker cached_method();

}  // namespace terracut::simulation
