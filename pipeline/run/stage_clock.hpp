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
/// processor time of a frame until take(), even if its work is interrupted. `Clock` is like
/// measure::SystemClock.
template <class Clock>
class StageClockOf final : public stage::StageObserver {
 public:
  explicit StageClockOf(Clock clock = {}) noexcept : clock_(clock) {}

  void resumed() noexcept TERRACUT_NONBLOCKING override { last_ns_ = clock_.thread_cpu_ns(); }
  void stage_done(stage::Stage stage) noexcept TERRACUT_NONBLOCKING override {
    const std::int64_t now_ns = clock_.thread_cpu_ns();
    times_.stage_ns[static_cast<std::size_t>(stage)] += now_ns - std::exchange(last_ns_, now_ns);
  }
  /// Returns the time of the present frame's stages so far.
  [[nodiscard]] std::int64_t sum_ns() const noexcept TERRACUT_NONBLOCKING {
    return times_.sum_ns();
  }
  /// Returns the times of the present frame and begins the next frame.
  stage::StageTimes take() noexcept TERRACUT_NONBLOCKING {
    return std::exchange(times_, stage::StageTimes{});
  }

 private:
  Clock clock_;
  stage::StageTimes times_;
  std::int64_t last_ns_ = 0;
};

using StageClock = StageClockOf<measure::SystemClock>;

}  // namespace terracut::run
