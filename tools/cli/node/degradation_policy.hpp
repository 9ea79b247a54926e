// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "pipeline/ground/segmenter.hpp"
#include "pipeline/min_cut/cut_budget.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "pipeline/status/frame_record.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::cli {

/// Decides how far a frame is refined before its deadline: by the whole method, by a min-cut that
/// is stopped when time runs out, by the coarse stages alone, or not at all. It predicts a stage's
/// cost from the last three frames that ran the stage. A stage that is left out cannot be measured,
/// so after some frames it is tried, whatever the prediction:
///
/// A frame is skipped if even the least of the last three costs of the coarse stages does not fit.
/// After two skipped frames the next one is tried. The trial costs no miss, because a skipped frame
/// misses its deadline as well; a late trial counts as skipped (end()).
///
/// The cut is left out if the greatest of its last three costs does not fit, because a cut begun in
/// vain delays the labels. After two frames without a cut the next one is tried. Each trial that
/// makes its frame late doubles the number of frames before the next trial, up to 32: during a long
/// overload one frame in 33 is late to find out whether the overload has ended.
///
/// So after a slow frame or an overload, labels return within three frames, and so does the whole
/// method unless earlier trials of the cut made frames late.
///
/// Real-time safe; one thread. `Clock` is like measure::SystemClock.
template <class Clock>
class DegradationPolicyOf {
 public:
  /// `deadline_ns` is the time from a frame's last packet to its labels.
  explicit DegradationPolicyOf(std::int64_t deadline_ns, Clock clock = {}) noexcept
      : clock_(clock),
        deadline_ns_(deadline_ns),
        unseen_stop_ns_(kMargin_ns + std::min(deadline_ns / 8, kUnseenStop_ns)),
        stopping_(unseen_stop_ns_) {}

  /// Begins a frame. Returns false if not even its coarse stages would end in time: skip the frame.
  [[nodiscard]] bool begin(std::int64_t last_packet_ns) noexcept TERRACUT_NONBLOCKING {
    due_ns_ = last_packet_ns + deadline_ns_;
    before_cut_ = true;
    tries_cut_ = false;
    stopped_cpu_ns_ = 0;
    const std::int64_t left_ns = due_ns_ - clock_.realtime_ns();
    const bool fits = left_ns >= coarse_.least_ns();
    if (left_ns <= 0 || (!fits && skipped_ < kMostInARow)) {
      ++skipped_;
      return false;
    }
    is_trial_ = !fits;
    skipped_ = 0;
    return true;
  }
  /// Returns the cut's budget for this frame, valid as long as this object. It expires early enough
  /// for the stages after the cut. Asked before the cut has begun, it counts as expired unless the
  /// cut can probably end in time.
  [[nodiscard]] min_cut::CutBudget budget() noexcept TERRACUT_NONBLOCKING {
    return {min_cut::CutBudget::kDefaultOps,
            [](void* degradation) noexcept TERRACUT_NONBLOCKING {
              return static_cast<DegradationPolicyOf*>(degradation)->expired();
            },
            this};
  }
  /// True if the frame's labels may be handed on; false for a trial that is late.
  [[nodiscard]] bool may_hand_on() const noexcept TERRACUT_NONBLOCKING {
    return !is_trial_ || clock_.realtime_ns() <= due_ns_;
  }
  /// Ends the frame and learns its costs. `handing_on_ns` is the cost of handing on labels.
  void end(const stage::StageTimes& times, const stage::SegmentationReport& report,
           std::int64_t handing_on_ns) noexcept TERRACUT_NONBLOCKING {
    using stage::Stage;
    const auto cost_ns = [&](Stage stage) {
      return times.stage_ns[static_cast<std::size_t>(stage)];
    };
    const std::int64_t labels_ns = cost_ns(Stage::kLabels) + handing_on_ns + kMargin_ns;
    labels_.add(labels_ns);
    coarse_.add(cost_ns(Stage::kElevationMap) + cost_ns(Stage::kAdjacentPoints) + labels_ns);
    if (before_cut_) return;
    // The time that labels take after a cut was stopped is known only if this cut was stopped.
    if (stopped_cpu_ns_ != 0) {
      stopping_.add(clock_.thread_cpu_ns() - stopped_cpu_ns_ + kMargin_ns);
    }
    const std::int64_t spent_ns = cost_ns(Stage::kSeeds) + cost_ns(Stage::kMinCut);
    if (report.cut.discarded) {
      cut_.add(spent_ns + spent_ns / 8);
    } else if (tries_cut_) {
      cut_ = LastThree(cost_ns(Stage::kSeeds));
    } else {
      cut_.add(cost_ns(Stage::kSeeds));
    }
    if (!tries_cut_ || is_trial_) return;
    const bool late = clock_.realtime_ns() > due_ns_;
    cut_rest_ = late ? std::min(2 * cut_rest_, kMostRest) : kMostInARow;
  }

  [[nodiscard]] static status::Level level_of(const stage::SegmentationReport& report) noexcept {
    if (report.last_stage < stage::Stage::kMinCut) return status::Level::kCoarse;
    return report.cut.coarse_by_budget > 0 ? status::Level::kCutStopped : status::Level::kFull;
  }

 private:
  /// The costs of one kind of work in the last three frames that did it; estimates at first.
  class LastThree {
   public:
    explicit LastThree(std::int64_t expected_ns) noexcept {
      took_ns_ = {expected_ns, expected_ns, expected_ns};
    }
    void add(std::int64_t took_ns) noexcept {
      took_ns_[next_] = took_ns;
      next_ = next_ == 2 ? 0 : next_ + 1;
    }
    [[nodiscard]] std::int64_t least_ns() const noexcept {
      return std::min({took_ns_[0], took_ns_[1], took_ns_[2]});
    }
    [[nodiscard]] std::int64_t most_ns() const noexcept {
      return std::max({took_ns_[0], took_ns_[1], took_ns_[2]});
    }

   private:
    std::array<std::int64_t, 3> took_ns_;
    std::size_t next_ = 0;
  };

  /// Returns the time to reserve for the stages after a cut.
  [[nodiscard]] std::int64_t after_cut_ns() const noexcept {
    return std::max(labels_.most_ns(), stopping_.most_ns());
  }
  /// Returns true if the cut must not begin or must stop. The first call in a frame comes before
  /// the seeds and the cut, later calls come where the cut can be stopped.
  [[nodiscard]] bool expired() noexcept TERRACUT_NONBLOCKING {
    const std::int64_t left_ns = due_ns_ - clock_.realtime_ns();
    if (before_cut_) {
      if (!may_begin_cut(left_ns)) return true;
      before_cut_ = false;
    }
    if (left_ns >= after_cut_ns()) return false;
    if (stopped_cpu_ns_ == 0) stopped_cpu_ns_ = clock_.thread_cpu_ns();
    return true;
  }
  [[nodiscard]] bool may_begin_cut(std::int64_t left_ns) noexcept {
    if (left_ns >= after_cut_ns() + cut_.most_ns()) {
      cut_left_out_ = 0;
      return true;
    }
    if (cut_left_out_ < cut_rest_) {
      ++cut_left_out_;
      return false;
    }
    cut_left_out_ = 0;
    tries_cut_ = true;
    if (left_ns < after_cut_ns()) {  // otherwise the cut would be stopped at once
      stopping_ = LastThree(unseen_stop_ns_);
      labels_ = LastThree(labels_.least_ns());
    }
    return true;
  }

  /// The most frames skipped in a row, and the longest rest between trials of the cut, in frames.
  static constexpr int kMostInARow = 2;
  static constexpr int kMostRest = 32;
  /// Time reserved for waking up late and for handing labels on.
  static constexpr std::int64_t kMargin_ns = 500'000;
  /// Time reserved for the labels after a stopped cut until one has been measured; at most an
  /// eighth of the deadline.
  static constexpr std::int64_t kUnseenStop_ns = 3'000'000;

  Clock clock_;
  std::int64_t deadline_ns_;
  std::int64_t unseen_stop_ns_;

  LastThree coarse_{kMargin_ns};  ///< Cost of all stages except seeds and cut.
  LastThree labels_{kMargin_ns};  ///< Cost of the stages after the cut.
  LastThree stopping_;            ///< Time from stopping a cut to the end of the frame.
  LastThree cut_{0};              ///< Least cost of a useful cut, seeds included.
  int skipped_ = 0;               ///< Successive frames skipped.
  int cut_left_out_ = 0;          ///< Successive cuts left out.
  int cut_rest_ = kMostInARow;

  // State of the frame being processed.
  std::int64_t due_ns_ = 0;
  bool is_trial_ = false, tries_cut_ = false;
  bool before_cut_ = true;
  std::int64_t stopped_cpu_ns_ = 0;
};

using DegradationPolicy = DegradationPolicyOf<measure::SystemClock>;

}  // namespace terracut::cli
