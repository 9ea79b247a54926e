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
  explicit DeadlineLadder(std::int64_t deadline_ns) noexcept
      : deadline_ns_(deadline_ns),
        after_cut_ns_(kMargin_ns + std::min(deadline_ns / 8, kStopUnseen_ns)) {}

  /// A frame begins. False when not even the coarse stages would be done in time.
  [[nodiscard]] bool begin(std::int64_t last_packet_ns) noexcept TERRACUT_NONBLOCKING {
    due_ns_ = last_packet_ns + deadline_ns_;
    before_cut_ = true;
    stopped_cpu_ns_ = 0;
    if (rt::realtime_ns() + coarse_ns_ <= due_ns_) return true;
    coarse_ns_ -= coarse_ns_ / kSlowly;
    return false;
  }
  /// For the segmenter, for the frame that was begun: expires so early that what follows the cut
  /// still fits, and, when asked before the cut, where a cut would come to nothing. Valid while
  /// this is.
  [[nodiscard]] pipeline::CutBudget budget() noexcept TERRACUT_NONBLOCKING {
    return {pipeline::CutBudget::kDefaultOps,
            [](void* ladder) noexcept TERRACUT_NONBLOCKING {
              return static_cast<DeadlineLadder*>(ladder)->expired();
            },
            this};
  }
  /// The frame is done: learns from it. `handing_on_ns`: of processor time, for its labels.
  void end(const StageTimes& times, const pipeline::SegmentationReport& report,
           std::int64_t handing_on_ns) noexcept TERRACUT_NONBLOCKING {
    using pipeline::Stage;
    const auto cost_ns = [&](Stage stage) {
      return times.stage_ns[static_cast<std::size_t>(stage)];
    };
    const std::int64_t labels_ns = cost_ns(Stage::kLabels) + handing_on_ns + kMargin_ns;
    // A cut that was stopped still has to make labels of what it has; one that was not tells
    // nothing of what that costs.
    if (stopped_cpu_ns_ != 0) {
      learn(after_cut_ns_, rt::thread_cpu_ns() - stopped_cpu_ns_ + kMargin_ns);
    } else {
      after_cut_ns_ = std::max(labels_ns, after_cut_ns_ - after_cut_ns_ / kSlowly);
    }
    if (!before_cut_) {
      const std::int64_t spent_ns = cost_ns(Stage::kSeeds) + cost_ns(Stage::kMinCut);
      const bool in_vain = report.cut.discarded;
      learn(cut_needs_ns_, in_vain ? spent_ns + spent_ns / 8 : cost_ns(Stage::kSeeds));
    }
    learn(coarse_ns_, cost_ns(Stage::kElevationMap) + cost_ns(Stage::kAdjacentPoints) + labels_ns);
  }

  [[nodiscard]] static rt::Rung rung_of(const pipeline::SegmentationReport& report) noexcept {
    if (report.last_stage < pipeline::Stage::kMinCut) return rt::Rung::kCoarse;
    return report.cut.coarse_by_budget > 0 ? rt::Rung::kCutStopped : rt::Rung::kFull;
  }

 private:
  /// The first look of a frame comes before the seeds and the cut, all others where it can be
  /// stopped.
  [[nodiscard]] bool expired() noexcept TERRACUT_NONBLOCKING {
    const std::int64_t left_ns = due_ns_ - rt::realtime_ns() - after_cut_ns_;
    if (before_cut_) {
      if (left_ns < cut_needs_ns_) {
        cut_needs_ns_ -= cut_needs_ns_ / kNowAndThen;
        return true;
      }
      before_cut_ = false;
    }
    if (left_ns >= 0) return false;
    if (stopped_cpu_ns_ == 0) stopped_cpu_ns_ = rt::thread_cpu_ns();
    return true;
  }

  /// What is left out teaches nothing. It is tried again when what the dearest frame taught has
  /// faded, by this part a frame. Seldom, where the frame it is tried on may miss its deadline ...
  static constexpr std::int64_t kSlowly = 1024;
  /// ... and sooner where it can be stopped.
  static constexpr std::int64_t kNowAndThen = 256;
  /// For waking up late and for handing over.
  static constexpr std::int64_t kMargin_ns = 500'000;
  /// What is set aside for making labels of a stopped cut as long as none has been seen, or an
  /// eighth of the deadline where that is less.
  static constexpr std::int64_t kStopUnseen_ns = 3'000'000;

  /// Rises at once, sinks slowly: the dearest frame of the last ones counts.
  static void learn(std::int64_t& kept_ns, std::int64_t seen_ns) noexcept {
    kept_ns = std::max(seen_ns, kept_ns - kept_ns / 32);
  }

  std::int64_t deadline_ns_;
  std::int64_t due_ns_ = 0;
  std::int64_t coarse_ns_ = kMargin_ns;
  std::int64_t after_cut_ns_;
  /// What a cut takes that comes to something, at least: its seeds, and more than was in vain.
  std::int64_t cut_needs_ns_ = 0;
  std::int64_t stopped_cpu_ns_ = 0;
  bool before_cut_ = true;
};

}  // namespace terracut::cli
