// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "pipeline/stage/stage.hpp"
#include "pipeline/stage/stage_times.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::run {

/// Measures the times of the pipeline's stages, because the pipeline itself has no clock. Sums the
/// times of a frame until take(), even if its work is interrupted. `Clock` is like
/// measure::SystemClock.
template <class Clock>
class StageClockOf final : public stage::StageObserver {
 public:
  explicit StageClockOf(Clock clock = {}) noexcept : clock_(clock) {}

  void resumed() noexcept TERRACUT_NONBLOCKING override { last_ = now(); }
  void stage_done(stage::Stage stage) noexcept TERRACUT_NONBLOCKING override {
    const measure::ClockPair now = this->now();
    const measure::ClockPair spent = now.since(last_);
    times_.stage_ns[static_cast<std::size_t>(stage)] += spent.cpu_ns;
    times_.segment_wall_ns += spent.wall_ns;
    last_ = now;
  }
  /// Returns the times of the present frame and begins the next frame.
  stage::StageTimes take() noexcept TERRACUT_NONBLOCKING {
    return std::exchange(times_, stage::StageTimes{});
  }

 private:
  [[nodiscard]] measure::ClockPair now() const noexcept TERRACUT_NONBLOCKING {
    return {clock_.thread_cpu_ns(), clock_.monotonic_ns()};
  }

  Clock clock_;
  stage::StageTimes times_;
  measure::ClockPair last_;
};

using StageClock = StageClockOf<measure::SystemClock>;

}  // namespace terracut::run
