// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "pipeline/stage.hpp"
#include "rt/nonblocking.hpp"
#include "rt/thread_cpu_clock.hpp"

namespace terracut::cli {

/// Processor time of one frame by stage, nanoseconds of the segmenting thread.
struct StageTimes {
  std::array<std::int64_t, pipeline::kStages> stage_ns{};
  std::int64_t segment_wall_ns = 0;  ///< While at work on the frame, by the wall clock.

  [[nodiscard]] std::int64_t sum_ns() const noexcept TERRACUT_NONBLOCKING {
    std::int64_t sum = 0;
    for (const std::int64_t one_ns : stage_ns) sum += one_ns;
    return sum;
  }
};

/// Times the stages of the pipeline, which has no clock of its own: those of a frame, however often
/// it was left and gone on with, until its times are taken.
/// `Clock`: as rt::SystemClock.
template <class Clock>
class StageClockOf final : public pipeline::StageObserver {
 public:
  explicit StageClockOf(Clock clock = {}) noexcept : clock_(clock) {}

  void resumed() noexcept TERRACUT_NONBLOCKING override { last_ = now(); }
  void stage_done(pipeline::Stage stage) noexcept TERRACUT_NONBLOCKING override {
    const rt::ClockPair now = this->now();
    const rt::ClockPair spent = now.since(last_);
    times_.stage_ns[static_cast<std::size_t>(stage)] += spent.cpu_ns;
    times_.segment_wall_ns += spent.wall_ns;
    last_ = now;
  }
  /// Of the frame so far.
  [[nodiscard]] const StageTimes& times() const noexcept { return times_; }
  /// Its times; the next frame begins.
  StageTimes take() noexcept TERRACUT_NONBLOCKING { return std::exchange(times_, StageTimes{}); }

 private:
  [[nodiscard]] rt::ClockPair now() const noexcept TERRACUT_NONBLOCKING {
    return {clock_.thread_cpu_ns(), clock_.monotonic_ns()};
  }

  Clock clock_;
  StageTimes times_;
  rt::ClockPair last_;
};

using StageClock = StageClockOf<rt::SystemClock>;

}  // namespace terracut::cli
