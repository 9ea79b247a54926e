// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>

#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/segmenter.hpp"
#include "rt/frame_timing.hpp"
#include "rt/nonblocking.hpp"
#include "rt/thread_cpu_clock.hpp"
#include "tools/cli/stage_clock.hpp"

namespace terracut::cli {

/// How far a frame is refined before its deadline: the whole method; the min-cut stopped where time
/// ran out; the coarse stages alone; or not at all. Measures what the stages cost as it goes, so
/// that it knows what still fits. Real-time safe; one thread.
class DeadlineLadder {
 public:
  /// From a turn's last packet to its labels.
  explicit DeadlineLadder(std::int64_t deadline_ns) noexcept : deadline_ns_(deadline_ns) {}

  /// A frame begins. False when not even the coarse stages would be done in time.
  [[nodiscard]] bool begin(std::int64_t last_packet_ns) noexcept TERRACUT_NONBLOCKING {
    due_ns_ = last_packet_ns + deadline_ns_;
    return rt::realtime_ns() + coarse_ns_ <= due_ns_;
  }
  /// For the segmenter: expires so early that what follows the cut still fits. Valid while this is.
  [[nodiscard]] pipeline::CutBudget budget() noexcept TERRACUT_NONBLOCKING {
    return {pipeline::CutBudget::kDefaultOps,
            [](void* ladder) noexcept TERRACUT_NONBLOCKING {
              const auto& self = *static_cast<const DeadlineLadder*>(ladder);
              return rt::realtime_ns() + self.after_cut_ns_ > self.due_ns_;
            },
            this};
  }
  /// The frame is done: learns from it.
  void end(const StageTimes& times) noexcept TERRACUT_NONBLOCKING {
    using pipeline::Stage;
    const auto cost_ns = [&](Stage stage) {
      return times.stage_ns[static_cast<std::size_t>(stage)];
    };
    const std::int64_t labels_ns = cost_ns(Stage::kLabels);
    learn(after_cut_ns_, labels_ns + kMargin_ns);
    learn(coarse_ns_,
          cost_ns(Stage::kElevationMap) + cost_ns(Stage::kAdjacentPoints) + labels_ns + kMargin_ns);
  }

  [[nodiscard]] static rt::Rung rung_of(const pipeline::SegmentationReport& report) noexcept {
    if (report.last_stage < pipeline::Stage::kMinCut) return rt::Rung::kCoarse;
    return report.cut.coarse_by_budget > 0 ? rt::Rung::kCutStopped : rt::Rung::kFull;
  }

 private:
  /// For waking up late and for handing over.
  static constexpr std::int64_t kMargin_ns = 500'000;

  /// Rises at once, sinks slowly: the dearest frame of the last ones counts.
  static void learn(std::int64_t& kept_ns, std::int64_t seen_ns) noexcept {
    kept_ns = std::max(seen_ns, kept_ns - kept_ns / 32);
  }

  std::int64_t deadline_ns_;
  std::int64_t due_ns_ = 0;
  std::int64_t coarse_ns_ = kMargin_ns, after_cut_ns_ = kMargin_ns;
};

}  // namespace terracut::cli
