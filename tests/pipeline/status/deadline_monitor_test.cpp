// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/deadline_monitor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string_view>
#include <vector>

#include "tests/support/allocation_counter.hpp"

namespace terracut::status {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStart_ns = 1'700'000'000'000 * kMs;
constexpr std::array<std::string_view, 2> kStages{"elevation_map", "min_cut"};

/// Frame `number` of a sensor at 10 Hz, whose labels came `latency_ms` after its last packet.
FrameRecord frame_of(std::uint32_t number, std::int64_t latency_ms) {
  FrameRecord frame;
  frame.info.number = number;
  frame.info.returns = 1000;
  frame.segmentation.below = 7;
  frame.info.last_packet_ns = kStart_ns + number * 100 * kMs;
  frame.closing_packet_ns = frame.info.last_packet_ns;
  frame.handed_over_ns = frame.info.last_packet_ns + 1 * kMs;
  frame.labels_ns = frame.info.last_packet_ns + latency_ms * kMs;
  frame.decode_cpu_ns = 3 * kMs;
  frame.segment_cpu_ns = 6 * kMs;
  frame.stages.stage_ns = {2 * kMs, 4 * kMs};
  return frame;
}

class DeadlineMonitorOf50Ms : public testing::Test {
 protected:
  memory::FixedMemory memory_;
  DeadlineMonitor monitor_{{.deadline_ns = 50 * kMs, .stage_names = kStages, .kept_frames = 8},
                           memory_};

  FrameRecord judged(FrameRecord frame) {
    monitor_.judge(frame);
    return frame;
  }
  [[nodiscard]] std::uint64_t misses(FrameMissCause cause) const {
    return monitor_.snapshot().misses[static_cast<std::size_t>(cause)];
  }
  [[nodiscard]] std::uint64_t levels(Level level) const {
    return monitor_.snapshot().levels[static_cast<std::size_t>(level)];
  }
};

TEST_F(DeadlineMonitorOf50Ms, MissesOnlyWhatIsLaterThanTheDeadline) {
  EXPECT_FALSE(judged(frame_of(0, 50)).missed);
  FrameRecord late = frame_of(1, 50);
  ++late.labels_ns;
  EXPECT_TRUE(judged(late).missed);
  EXPECT_EQ(monitor_.snapshot().frames, 2U);
  EXPECT_EQ(monitor_.snapshot().all_misses(), 1U);
}

TEST_F(DeadlineMonitorOf50Ms, CountsWhetherTheVehiclesMotionWasKnownAndHowOldItWas) {
  judged(frame_of(0, 10));
  EXPECT_EQ(monitor_.snapshot().motion.deskewed + monitor_.snapshot().motion.no_ego_motion, 0U);
  FrameRecord frame = frame_of(1, 10);
  frame.info.deskew.state = frame::DeskewState::kDone;
  for (const std::int64_t after_frame_ms : {-12, 3, -6}) {
    frame.info.deskew.newest_motion_ns = after_frame_ms * kMs;
    judged(frame);
  }
  frame.info.deskew.state = frame::DeskewState::kNoEgoMotion;
  frame.info.deskew.newest_motion_ns = -900 * kMs;
  judged(frame);
  const MotionFigures& motion = monitor_.snapshot().motion;
  EXPECT_EQ(motion.deskewed, 3U);
  EXPECT_EQ(motion.no_ego_motion, 1U);
  EXPECT_EQ(motion.newest_sample_after_frame_ns, -900 * kMs);
  EXPECT_EQ(motion.least_sample_after_frame_ns, -12 * kMs);
  EXPECT_EQ(motion.most_sample_after_frame_ns, 3 * kMs);
  EXPECT_DOUBLE_EQ(motion.mean_sample_after_frame_ns(), -5.0 * kMs);
}

TEST_F(DeadlineMonitorOf50Ms, BlamesOwnWorkForWhatNothingElseExplains) {
  EXPECT_EQ(judged(frame_of(0, 80)).cause, FrameMissCause::kOwnWork);
  EXPECT_EQ(misses(FrameMissCause::kOwnWork), 1U);
}

TEST_F(DeadlineMonitorOf50Ms, BlamesTheLargestShareOfTheLatency) {
  FrameRecord frame = frame_of(0, 100);
  frame.run_queue_wait_ns = 60 * kMs;
  EXPECT_EQ(judged(frame).cause, FrameMissCause::kWaitingForCore);
  frame.run_queue_wait_ns = 40 * kMs;
  EXPECT_EQ(judged(frame).cause, FrameMissCause::kOwnWork);
  frame.closing_packet_ns += 70 * kMs;
  EXPECT_EQ(judged(frame).cause, FrameMissCause::kLateInput);
}

TEST_F(DeadlineMonitorOf50Ms, TakesAWaitThatTheHypervisorCausedForStolenTimeOnce) {
  FrameRecord frame = frame_of(0, 100);
  frame.steal_ns = 55 * kMs;
  frame.run_queue_wait_ns = 60 * kMs;  // 55 of them are the same
  EXPECT_EQ(judged(frame).cause, FrameMissCause::kStolenTime);
  frame.steal_ns = 15 * kMs;
  frame.run_queue_wait_ns = 75 * kMs;
  EXPECT_EQ(judged(frame).cause, FrameMissCause::kWaitingForCore);
}

TEST_F(DeadlineMonitorOf50Ms, GivesOwnWorkTheBlameWhenSharesAreEqual) {
  FrameRecord frame = frame_of(0, 100);
  frame.steal_ns = 50 * kMs;
  EXPECT_EQ(judged(frame).cause, FrameMissCause::kOwnWork);
  frame.steal_ns += 1;
  EXPECT_EQ(judged(frame).cause, FrameMissCause::kStolenTime);
}

TEST_F(DeadlineMonitorOf50Ms, SharesOutNoMoreThanTheLatency) {
  FrameRecord frame = frame_of(0, 60);
  frame.closing_packet_ns += 40 * kMs;
  frame.steal_ns = 1000 * kMs;  // of all cores, say: at most the 20 ms that are left count
  EXPECT_EQ(judged(frame).cause, FrameMissCause::kLateInput);
}

TEST_F(DeadlineMonitorOf50Ms, SharesOutWhatIsLeftBehindALargeShare) {
  FrameRecord frame = frame_of(0, 80);
  frame.closing_packet_ns += 60 * kMs;
  frame.steal_ns = 70 * kMs;  // 20 ms are left
  EXPECT_EQ(judged(frame).cause, FrameMissCause::kLateInput);
}

TEST_F(DeadlineMonitorOf50Ms, TakesAStolenTimeThatWentBackwardsForNone) {
  FrameRecord frame = frame_of(0, 100);
  frame.run_queue_wait_ns = 40 * kMs;
  frame.steal_ns = -30 * kMs;
  EXPECT_EQ(judged(frame).cause, FrameMissCause::kOwnWork);
}

TEST_F(DeadlineMonitorOf50Ms, CountsASkippedFrameAsMissedButNotAsQuick) {
  FrameRecord skipped = frame_of(0, 2);
  skipped.level = Level::kSkipped;
  skipped.segment_cpu_ns = 0;
  EXPECT_TRUE(judged(skipped).missed);
  EXPECT_EQ(levels(Level::kSkipped), 1U);
  EXPECT_EQ(monitor_.snapshot().latency.count(), 0U);
  EXPECT_EQ(monitor_.snapshot().segment_cpu.count(), 0U);
  EXPECT_EQ(monitor_.snapshot().total_cpu.count(), 0U);
  EXPECT_EQ(monitor_.snapshot().decode_cpu.count(), 1U);
}

TEST_F(DeadlineMonitorOf50Ms, CountsFramesWhoseStampsGiveNoLatency) {
  FrameRecord set_back = frame_of(0, 10);
  set_back.labels_ns = set_back.info.last_packet_ns - 1;
  EXPECT_FALSE(judged(set_back).missed);
  FrameRecord without_stamp = frame_of(1, 10);
  without_stamp.info.last_packet_ns = 0;
  EXPECT_FALSE(judged(without_stamp).missed);
  EXPECT_EQ(monitor_.snapshot().unjudged, 2U);
  EXPECT_EQ(monitor_.snapshot().frames, 2U);
  EXPECT_EQ(monitor_.snapshot().latency.count(), 0U);
  EXPECT_EQ(monitor_.snapshot().total_cpu.count(), 2U);
}

TEST_F(DeadlineMonitorOf50Ms, TakesALatencyOfNothingForOne) {
  FrameRecord at_once = frame_of(0, 10);
  at_once.labels_ns = at_once.info.last_packet_ns;
  EXPECT_FALSE(judged(at_once).missed);
  EXPECT_EQ(monitor_.snapshot().latency.count(), 1U);
  EXPECT_EQ(monitor_.snapshot().unjudged, 0U);
}

TEST_F(DeadlineMonitorOf50Ms, CountsRunsOfMisses) {
  for (const std::int64_t latency_ms : {60, 60, 60, 10, 60, 60}) {
    judged(frame_of(0, latency_ms));
  }
  EXPECT_EQ(monitor_.snapshot().consecutive_misses, 2U);
  EXPECT_EQ(monitor_.snapshot().longest_run_of_misses, 3U);
  judged(frame_of(0, 10));
  EXPECT_EQ(monitor_.snapshot().consecutive_misses, 0U);
  EXPECT_EQ(monitor_.snapshot().longest_run_of_misses, 3U);
}

TEST_F(DeadlineMonitorOf50Ms, RecordsEveryTimeUnderItsOwnHistogram) {
  judged(frame_of(0, 20));
  const MonitorSnapshot& figures = monitor_.snapshot();
  EXPECT_EQ(figures.latency.max_ns(), 20 * kMs);
  EXPECT_EQ(figures.wall.max_ns(), 19 * kMs);
  EXPECT_EQ(figures.decode_cpu.max_ns(), 3 * kMs);
  EXPECT_EQ(figures.segment_cpu.max_ns(), 6 * kMs);
  EXPECT_EQ(figures.total_cpu.max_ns(), 9 * kMs);
  ASSERT_EQ(figures.stages(), 2U);
  EXPECT_EQ(figures.stage_names[1].view(), "min_cut");
  EXPECT_EQ(figures.stage_cpu[0].max_ns(), 2 * kMs);
  EXPECT_EQ(figures.stage_cpu[1].max_ns(), 4 * kMs);
  EXPECT_EQ(figures.returns, 1000U);
}

TEST_F(DeadlineMonitorOf50Ms, AddsUpReturnsOverFrames) {
  judged(frame_of(0, 20));
  FrameRecord skipped = frame_of(1, 20);
  skipped.level = Level::kSkipped;
  judged(skipped);
  EXPECT_EQ(monitor_.snapshot().returns, 2000U);
  EXPECT_EQ(monitor_.snapshot().returns_below, 14U);
}

TEST_F(DeadlineMonitorOf50Ms, LeavesAStageThatDidNotRunOutOfItsHistogram) {
  FrameRecord coarse = frame_of(0, 20);
  coarse.level = Level::kCoarse;
  coarse.stages.stage_ns[1] = 0;
  judged(coarse);
  EXPECT_EQ(levels(Level::kCoarse), 1U);
  EXPECT_EQ(monitor_.snapshot().stage_cpu[0].count(), 1U);
  EXPECT_EQ(monitor_.snapshot().stage_cpu[1].count(), 0U);
}

TEST_F(DeadlineMonitorOf50Ms, TellsTheRateOfTheNewestFrames) {
  judged(frame_of(0, 10));
  EXPECT_EQ(monitor_.snapshot().frames_per_s, 0.0);
  for (std::uint32_t number = 1; number < 100; ++number) judged(frame_of(number, 10));
  EXPECT_DOUBLE_EQ(monitor_.snapshot().frames_per_s, 10.0);
}

TEST_F(DeadlineMonitorOf50Ms, HasNoRateOnceTheNewestFrameIsMoreThanASecondOld) {
  for (std::uint32_t number = 0; number < 5; ++number) judged(frame_of(number, 10));
  monitor_.look_at_rate(kStart_ns + 1400 * kMs);
  EXPECT_DOUBLE_EQ(monitor_.snapshot().frames_per_s, 10.0);
  monitor_.look_at_rate(kStart_ns + 1401 * kMs);
  EXPECT_EQ(monitor_.snapshot().frames_per_s, 0.0);
}

TEST_F(DeadlineMonitorOf50Ms, TellsTheRateOfTheFramesAfterAGap) {
  for (std::uint32_t number = 0; number < 5; ++number) judged(frame_of(number, 10));
  for (std::uint32_t number = 100; number < 103; ++number) judged(frame_of(number, 10));
  EXPECT_DOUBLE_EQ(monitor_.snapshot().frames_per_s, 10.0);
}

TEST_F(DeadlineMonitorOf50Ms, TellsTheSameRateWhereASkippedFrameIsJudgedEarly) {
  for (const std::uint32_t number : {0U, 1U, 2U, 4U, 3U}) judged(frame_of(number, 10));
  EXPECT_DOUBLE_EQ(monitor_.snapshot().frames_per_s, 10.0);
}

TEST_F(DeadlineMonitorOf50Ms, KeepsTheNewestFramesInTheirOrder) {
  std::array<FrameRecord, 20> newest;
  EXPECT_EQ(monitor_.copy_newest(newest), 0U);
  for (std::uint32_t number = 0; number < 21; ++number) judged(frame_of(number, 60));
  ASSERT_EQ(monitor_.copy_newest(newest), 8U);
  for (std::uint32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(newest[i].info.number, 13 + i);
    EXPECT_TRUE(newest[i].missed);
  }
  ASSERT_EQ(monitor_.copy_newest(std::span(newest).first(3)), 3U);
  EXPECT_EQ(newest[0].info.number, 18U);
  EXPECT_EQ(newest[2].info.number, 20U);
}

TEST_F(DeadlineMonitorOf50Ms, SurvivesAnyNumbersInAFrame) {
  FrameRecord wild = frame_of(0, 10);
  wild.info.last_packet_ns = 1;
  wild.labels_ns = std::numeric_limits<std::int64_t>::max();
  wild.closing_packet_ns = -5;
  wild.steal_ns = -7;
  wild.run_queue_wait_ns = -1;
  wild.level = static_cast<Level>(200);
  EXPECT_TRUE(judged(wild).missed);
  EXPECT_EQ(wild.cause, FrameMissCause::kOwnWork);
  EXPECT_EQ(to_string(wild.level), "unknown");
  EXPECT_EQ(monitor_.snapshot().frames, 1U);
}

TEST(DeadlineMonitor, TakesNoMoreStagesThanAFrameHas) {
  memory::FixedMemory memory;
  const std::vector<std::string_view> names(20, "stage");
  const DeadlineMonitor monitor({.stage_names = names}, memory);
  EXPECT_EQ(monitor.snapshot().stages(), MonitorSnapshot::kMaxStages);
}

TEST(DeadlineMonitor, AllocatesNothingAfterItsConstruction) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer has its own allocator";
  memory::FixedMemory memory;
  DeadlineMonitor monitor({.stage_names = kStages, .kept_frames = 16}, memory);
  std::array<FrameRecord, 16> newest;
  const std::uint64_t before = test::allocations_of_this_thread();
  for (std::uint32_t number = 0; number < 100; ++number) {
    FrameRecord frame = frame_of(number, number);
    monitor.judge(frame);
    monitor.copy_newest(newest);
  }
  EXPECT_EQ(test::allocations_of_this_thread(), before);
  EXPECT_EQ(monitor.snapshot().all_misses(), 49U);
}

TEST(MonitorSnapshot, IsSafeToReadWhateverItsCountsSay) {
  MonitorSnapshot garbage;
  garbage.motion.fault_count = 0xFFFFFFFF;
  garbage.stage_count = garbage.loss_count = garbage.thread_count = 0xFFFFFFFF;
  garbage.link = static_cast<LinkState>(77);
  garbage.motion.state = static_cast<MotionState>(77);
  EXPECT_EQ(garbage.stages(), MonitorSnapshot::kMaxStages);
  EXPECT_EQ(garbage.losses_in_use().size(), MonitorSnapshot::kMaxLosses);
  EXPECT_EQ(garbage.threads_in_use().size(), MonitorSnapshot::kMaxThreads);
  EXPECT_EQ(garbage.motion.faults_in_use().size(), MotionFigures::kMaxFaults);
  EXPECT_EQ(to_string(garbage.link), "unknown");
  EXPECT_EQ(to_string(garbage.motion.state), "unknown");
  EXPECT_EQ(to_string(static_cast<frame::DeskewState>(77)), "unknown");
}

TEST(FixedText, CutsOffWhatIsTooLong) {
  EXPECT_EQ(memory::FixedText<8>("short").view(), "short");
  EXPECT_EQ(memory::FixedText<8>("exactly8").view(), "exactly8");
  EXPECT_EQ(memory::FixedText<8>("much too long").view(), "much too");
  EXPECT_TRUE(memory::FixedText<8>().empty());
}

}  // namespace
}  // namespace terracut::status
