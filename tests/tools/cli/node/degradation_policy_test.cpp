// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Frames on a made machine, whose clock is the test's: what takes how long is said for every frame.
#include "tools/cli/node/degradation_policy.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace terracut::cli {
namespace {

using stage::Stage;
using status::Level;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kFramePeriod_ns = 100 * kMs;

/// Stands still unless it is told; the thread does nothing but frames.
struct HeldClock {
  std::int64_t* now_ns;

  [[nodiscard]] std::int64_t realtime_ns() const noexcept { return *now_ns; }
  [[nodiscard]] std::int64_t thread_cpu_ns() const noexcept { return *now_ns; }
};

/// What a frame takes. The cut is stopped a millisecond after it is told so at the soonest, and is
/// of use from its first half on.
struct Work {
  std::int64_t coarse_ns = 0;  ///< Of the coarse stages, where this thread does them.
  std::int64_t seeds_ns = 1 * kMs;
  std::int64_t cut_ns = 3 * kMs;
  std::int64_t stop_ns = 0;  ///< Beyond labels, where the cut is stopped.
  std::int64_t labels_ns = 1 * kMs;
  std::int64_t late_hand_over_ns = 1 * kMs;  ///< After the frame's last packet.
};

struct Outcome {
  Level level{};
  bool in_time = false;
  bool had_cut = false;  ///< Begun, to whatever end.
};

/// The segmenting thread at 10 Hz: a frame that comes while it is busy is begun when it is free, or
/// never where a newer one has come by then.
class Machine {
 public:
  explicit Machine(std::int64_t deadline_ns)
      : deadline_ns_(deadline_ns), degradation_(deadline_ns, HeldClock{&now_ns_}) {}

  Outcome run(const Work& work) {
    const std::int64_t last_packet_ns = ++frames_ * kFramePeriod_ns;
    const std::int64_t due_ns = last_packet_ns + deadline_ns_;
    if (now_ns_ >= last_packet_ns + kFramePeriod_ns) return {Level::kSkipped};  // not taken
    now_ns_ = std::max(now_ns_, last_packet_ns + work.late_hand_over_ns);
    if (!degradation_.begin(last_packet_ns)) return {Level::kSkipped};
    stage::StageTimes times;
    const auto spend = [&](Stage stage, std::int64_t time_ns) {
      times.stage_ns[static_cast<std::size_t>(stage)] += time_ns;
      now_ns_ += time_ns;
    };
    spend(Stage::kElevationMap, work.coarse_ns);
    stage::SegmentationReport report;
    report.last_stage = Stage::kAdjacentPoints;
    const min_cut::CutBudget budget = degradation_.budget();
    const bool has_cut = !budget.expired(budget.context);
    if (has_cut) {
      report.last_stage = Stage::kMinCut;
      spend(Stage::kSeeds, work.seeds_ns);
      std::int64_t done_ns = 0;
      bool stopped = false;
      while (done_ns < work.cut_ns && !(stopped = budget.expired(budget.context))) {
        const std::int64_t step_ns = std::min(kMs, work.cut_ns - done_ns);
        spend(Stage::kMinCut, step_ns);
        done_ns += step_ns;
      }
      if (stopped) {
        spend(Stage::kMinCut, work.stop_ns);
        report.cut.coarse_by_budget = 1000;
        report.cut.discarded = 2 * done_ns < work.cut_ns;
        if (report.cut.discarded) report.last_stage = Stage::kAdjacentPoints;
      }
    }
    spend(Stage::kLabels, work.labels_ns);
    const bool handed_on = degradation_.may_hand_on();
    const bool in_time = now_ns_ <= due_ns;
    degradation_.end(times, report, 0);
    return {handed_on ? DegradationPolicy::level_of(report) : Level::kSkipped, handed_on && in_time,
            has_cut};
  }

  std::vector<Outcome> run(int frames, const Work& work) {
    std::vector<Outcome> outcomes;
    for (int i = 0; i < frames; ++i) outcomes.push_back(run(work));
    return outcomes;
  }
  /// Of a hundred quick frames: how many come before labels in time are back for good, and how many
  /// before the whole method is.
  struct Recovery {
    int labels = 0, whole_method = 0;
  };
  Recovery recover() {
    Recovery recovery;
    for (int i = 1; i <= 100; ++i) {
      const Outcome outcome = run({});
      if (!outcome.in_time) recovery.labels = i;
      if (!outcome.in_time || outcome.level != Level::kFull) recovery.whole_method = i;
    }
    return recovery;
  }

 private:
  std::int64_t deadline_ns_;
  std::int64_t now_ns_ = 0;
  std::int64_t frames_ = 0;
  DegradationPolicyOf<HeldClock> degradation_;
};

int count(const std::vector<Outcome>& outcomes, Level level) {
  int found = 0;
  for (const Outcome& outcome : outcomes) found += outcome.level == level ? 1 : 0;
  return found;
}
int late(const std::vector<Outcome>& outcomes) {
  int found = 0;
  for (const Outcome& outcome : outcomes) {
    found += outcome.level != Level::kSkipped && !outcome.in_time ? 1 : 0;
  }
  return found;
}

/// One thing of a frame that may take too long.
struct Part {
  const char* name;
  std::int64_t Work::* time_ns;
};
constexpr Part kParts[] = {{"coarse", &Work::coarse_ns},
                           {"seeds", &Work::seeds_ns},
                           {"cut", &Work::cut_ns},
                           {"labels", &Work::labels_ns}};

Work with(const Part& part, std::int64_t time_ns) {
  Work work;
  work.*part.time_ns = time_ns;
  return work;
}

TEST(DegradationPolicy, GivesEveryFrameTheWholeMethodWhereThereIsTime) {
  Machine machine(50 * kMs);
  EXPECT_EQ(count(machine.run(100, {}), Level::kFull), 100);
}

TEST(DegradationPolicy, IsBackWithinThreeFramesOfASlowOne) {
  struct Case {
    std::int64_t slow_ns, deadline_ns;
  };
  for (const auto& [slow_ns, deadline_ns] : {Case{60 * kMs, 50 * kMs},
                                             {100 * kMs, 50 * kMs},
                                             {200 * kMs, 50 * kMs},
                                             {12 * kMs, 10 * kMs}}) {
    for (const Part& part : kParts) {
      for (const int frames_before : {0, 1, 50}) {
        Machine machine(deadline_ns);
        (void)machine.run(frames_before, {});
        (void)machine.run(with(part, slow_ns));
        const Machine::Recovery recovery = machine.recover();
        const std::string what =
            fmt::format("{} ms of {}, deadline {} ms, after {} frames", slow_ns / kMs, part.name,
                        deadline_ns / kMs, frames_before);
        EXPECT_LT(recovery.labels, 3) << what;
        EXPECT_LE(recovery.whole_method, 3) << what;
      }
    }
  }
}

TEST(DegradationPolicy, IsBackWithinThreeFramesOfACutThatWasDearToStop) {
  Machine machine(50 * kMs);
  Work stopped;
  stopped.cut_ns = 60 * kMs;
  stopped.stop_ns = 45 * kMs;
  (void)machine.run(stopped);
  const Machine::Recovery recovery = machine.recover();
  EXPECT_LT(recovery.labels, 3);
  EXPECT_LE(recovery.whole_method, 3);
}

TEST(DegradationPolicy, IsBackWithinThreeFramesOfTheEndOfAnOverload) {
  for (const Part& part : kParts) {
    for (const std::int64_t slow_ns : {55 * kMs, 80 * kMs, 300 * kMs}) {
      for (const int frames : {3, 10, 101, 1000}) {
        Machine machine(50 * kMs);
        (void)machine.run(frames, with(part, slow_ns));
        const Machine::Recovery recovery = machine.recover();
        const std::string what =
            fmt::format("{} ms of {} in {} frames", slow_ns / kMs, part.name, frames);
        EXPECT_LT(recovery.labels, 3) << what;
        EXPECT_LE(recovery.whole_method, 33) << what;
      }
    }
  }
}

TEST(DegradationPolicy, HandsNothingOnTooLateAsLongAsTheCoarseStagesAreTooSlow) {
  for (const Part& part : {Part{"coarse", &Work::coarse_ns}, Part{"labels", &Work::labels_ns}}) {
    Machine machine(50 * kMs);
    (void)machine.run(3, with(part, 60 * kMs));
    const auto outcomes = machine.run(300, with(part, 60 * kMs));
    EXPECT_EQ(count(outcomes, Level::kSkipped), 300) << part.name;
  }
}

TEST(DegradationPolicy, TriesASkippedFrameThatFitsAsTheThird) {
  Machine machine(50 * kMs);
  (void)machine.run(9, with(kParts[0], 60 * kMs));
  const auto outcomes = machine.run(3, {});
  EXPECT_EQ(count(outcomes, Level::kSkipped), 2);
  EXPECT_NE(outcomes.back().level, Level::kSkipped);
  EXPECT_TRUE(outcomes.back().in_time);
}

TEST(DegradationPolicy, LabelsEveryFrameInTimeWhereTheCutAloneIsTooSlow) {
  for (const std::int64_t cut_ns : {30 * kMs, 60 * kMs, 200 * kMs, 2000 * kMs}) {
    Machine machine(50 * kMs);
    const auto outcomes = machine.run(300, with(kParts[2], cut_ns));
    EXPECT_EQ(late(outcomes) + count(outcomes, Level::kSkipped), 0) << cut_ns / kMs;
  }
}

TEST(DegradationPolicy, LeavesOutACutThatComesToNothingButNotForGood) {
  Machine machine(50 * kMs);
  const auto outcomes = machine.run(300, with(kParts[2], 200 * kMs));
  EXPECT_EQ(count(outcomes, Level::kCoarse), 300);
  EXPECT_EQ(std::ranges::count(outcomes, true, &Outcome::had_cut), 100) << "every third time";
  EXPECT_LE(machine.recover().whole_method, 3);
}

TEST(DegradationPolicy, PaysForTryingTheCutWithAMissNowAndThen) {
  // Stopping it takes longer than the deadline: every trial makes its frame late.
  Work work;
  work.cut_ns = 60 * kMs;
  work.stop_ns = 80 * kMs;
  Machine machine(50 * kMs);
  (void)machine.run(200, work);
  const auto outcomes = machine.run(660, work);
  EXPECT_GE(late(outcomes), 19) << "it is tried, all the same";
  EXPECT_LE(late(outcomes), 21) << "in one of 33 frames";
  EXPECT_LE(count(outcomes, Level::kSkipped), 21) << "and the frame behind it may find no time";
}

TEST(DegradationPolicy, RestsAsShortAsAtFirstOnceATrialOfTheCutWasInTime) {
  Work work;
  work.cut_ns = 60 * kMs;
  work.stop_ns = 80 * kMs;
  Machine machine(50 * kMs);
  (void)machine.run(200, work);
  (void)machine.recover();
  (void)machine.run(with(kParts[1], 60 * kMs));
  EXPECT_LE(machine.recover().whole_method, 3);
}

TEST(DegradationPolicy, DoesNotLayLabelsThatAreTooSlowAtTheCutsDoor) {
  Machine machine(50 * kMs);
  (void)machine.run(300, with(kParts[3], 60 * kMs));
  EXPECT_LE(machine.recover().whole_method, 6);
}

TEST(DegradationPolicy, NeverBeginsAFrameThatIsDueAlready) {
  std::int64_t now_ns = 50 * kMs;
  DegradationPolicyOf<HeldClock> degradation(50 * kMs, HeldClock{&now_ns});
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(degradation.begin(0));
  now_ns -= kMs;
  EXPECT_TRUE(degradation.begin(0));
}

TEST(DegradationPolicy, GivesQuickFramesTheWholeMethodAfterOneStoppedCut) {
  Machine machine(50 * kMs);
  EXPECT_EQ(machine.run(with(kParts[2], 60 * kMs)).level, Level::kCutStopped);
  EXPECT_EQ(count(machine.run(40, {}), Level::kFull), 40);
}

TEST(DegradationPolicy, CountsTheDeadlineFromTheLastPacket) {
  // Ten milliseconds are left: too few for this cut, enough for labels.
  Work late_hand_over;
  late_hand_over.cut_ns = 20 * kMs;
  EXPECT_EQ(Machine(50 * kMs).run(late_hand_over).level, Level::kFull);
  late_hand_over.late_hand_over_ns = 40 * kMs;
  const Outcome outcome = Machine(50 * kMs).run(late_hand_over);
  EXPECT_NE(outcome.level, Level::kFull);
  EXPECT_TRUE(outcome.in_time);
  late_hand_over.late_hand_over_ns = 50 * kMs;
  EXPECT_EQ(Machine(50 * kMs).run(late_hand_over).level, Level::kSkipped);
}

TEST(DegradationPolicy, SetsTimeAsideForAStoppedCutBeforeItHasSeenOne) {
  Work work;
  work.cut_ns = 60 * kMs;
  work.stop_ns = 2 * kMs;
  const Outcome outcome = Machine(50 * kMs).run(work);
  EXPECT_EQ(outcome.level, Level::kCutStopped);
  EXPECT_TRUE(outcome.in_time);
}

TEST(DegradationPolicy, SetsAsideWhatStoppingTook) {
  Work work;
  work.cut_ns = 60 * kMs;
  work.stop_ns = 8 * kMs;
  Machine machine(50 * kMs);
  EXPECT_FALSE(machine.run(work).in_time) << "nothing was known of it";
  for (const Outcome& outcome : machine.run(20, work)) EXPECT_TRUE(outcome.in_time);
}

TEST(DegradationPolicy, CountsHandingOnToWhatFollowsTheCut) {
  std::int64_t now_ns = 0;
  DegradationPolicyOf<HeldClock> degradation(50 * kMs, HeldClock{&now_ns});
  ASSERT_TRUE(degradation.begin(0));
  degradation.end({}, {}, 40 * kMs);
  now_ns = 12 * kMs;
  ASSERT_TRUE(degradation.begin(0));
  const min_cut::CutBudget budget = degradation.budget();
  EXPECT_TRUE(budget.expired(budget.context)) << "38 ms are left";
}

TEST(DegradationPolicy, MarksAFrameByWhatItsLabelsAreOf) {
  stage::SegmentationReport report;
  EXPECT_EQ(DegradationPolicy::level_of(report), Level::kFull);
  report.cut.coarse_by_budget = 1;
  EXPECT_EQ(DegradationPolicy::level_of(report), Level::kCutStopped);
  report.last_stage = Stage::kAdjacentPoints;
  EXPECT_EQ(DegradationPolicy::level_of(report), Level::kCoarse);
}

}  // namespace
}  // namespace terracut::cli
