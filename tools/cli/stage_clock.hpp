// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/stage.hpp"
#include "rt/nonblocking.hpp"
#include "rt/thread_cpu_clock.hpp"

namespace terracut::cli {

/// Processor time of one frame by stage, nanoseconds of the segmenting thread.
struct StageTimes {
  std::array<std::int64_t, pipeline::kStages> stage_ns{};
  std::int64_t segment_wall_ns = 0;  ///< From begin() to the last stage, by the wall clock.
};

/// Times the stages of the pipeline, which has no clock of its own. begin(), segment, times().
class StageClock final : public pipeline::StageObserver {
 public:
  void begin() noexcept TERRACUT_NONBLOCKING {
    times_ = {};
    begun_ = last_ = rt::ClockPair::now();
  }
  void stage_done(pipeline::Stage stage) noexcept TERRACUT_NONBLOCKING override {
    const rt::ClockPair now = rt::ClockPair::now();
    times_.stage_ns[static_cast<std::size_t>(stage)] += now.since(last_).cpu_ns;
    times_.segment_wall_ns = now.since(begun_).wall_ns;
    last_ = now;
  }
  [[nodiscard]] const StageTimes& times() const noexcept { return times_; }

 private:
  StageTimes times_;
  rt::ClockPair begun_, last_;
};

}  // namespace terracut::cli
