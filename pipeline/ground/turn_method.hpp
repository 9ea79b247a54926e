// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "pipeline/ground/frame_method.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/stage/segmentation_report.hpp"
#include "pipeline/stage/stage.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ground {

/// A method that labels the turns of a sensor, one after the other, while they arrive: ours
/// (StreamSegmenter), or one that labels each turn by itself (ClosedTurns). Takes all memory in its
/// constructor; real-time safe if the observer is. For one thread.
///
///   advance(turn, complete columns) ... end_turn(turn), then the same for the next turn
///   while (labelled() != nullptr) { read labels(); release(); }    after each of these calls
class TurnMethod {
 public:
  virtual ~TurnMethod() = default;

  /// Does what can be done on a turn that is still arriving: columns [0, complete_columns) are
  /// complete. Labels do not depend on how often this is called. A turn that has no returns yet may
  /// never be ended: its memory may be another turn's next.
  virtual void advance(const frame::MeasuredReturns& turn, int complete_columns,
                       const min_cut::CutBudget& budget,
                       stage::StageObserver* observer) noexcept TERRACUT_NONBLOCKING = 0;
  /// Takes the rest of a turn: all of it has come. It must stay unchanged until it is labelled.
  virtual void end_turn(const frame::MeasuredReturns& turn, const min_cut::CutBudget& budget,
                        stage::StageObserver* observer) noexcept TERRACUT_NONBLOCKING = 0;
  /// Labels the rest of the turns that have come whole: what follows them will not come, or not
  /// soon.
  virtual void close(const min_cut::CutBudget& budget,
                     stage::StageObserver* observer) noexcept TERRACUT_NONBLOCKING = 0;

  /// Returns the oldest turn that is labelled and not released, or null.
  [[nodiscard]] virtual const frame::MeasuredReturns* labelled() const noexcept
      TERRACUT_NONBLOCKING = 0;
  virtual void release() noexcept TERRACUT_NONBLOCKING = 0;

  /// Returns the oldest turn that has labels and is not released, or null.
  [[nodiscard]] virtual const frame::MeasuredReturns* at_work() const noexcept
      TERRACUT_NONBLOCKING = 0;
  /// Returns the labels of at_work() given so far, in order of arrival: one per return if it is
  /// labelled().
  [[nodiscard]] virtual std::span<const frame::Label> labels() const noexcept
      TERRACUT_NONBLOCKING = 0;
  /// Returns the heights above the ground of the returns that have labels(), metres, in the same
  /// order; empty if the method does not give heights, or was not asked for them.
  [[nodiscard]] virtual std::span<const float> heights_m() const noexcept TERRACUT_NONBLOCKING {
    return {};
  }
  /// From the next turn on, fills `ground` with the near ground of each turn that is labelled;
  /// null: no longer.
  virtual void watch_near_ground(NearGround* ground) noexcept TERRACUT_NONBLOCKING = 0;
  /// Returns the report of labelled().
  [[nodiscard]] virtual const stage::SegmentationReport& report() const noexcept
      TERRACUT_NONBLOCKING = 0;
};

/// Makes a method in `memory`, which must outlive it; FramesToCome::reader is set.
using TurnMethodMaker =
    std::function<std::unique_ptr<TurnMethod>(FramesToCome turns, memory::FixedMemory& memory)>;

}  // namespace terracut::ground
