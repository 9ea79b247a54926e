// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/health/health_reporter.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "firmware_io/can/socketcan_source.hpp"
#include "pipeline/health/health_frames.hpp"
#include "tests/firmware_io/can/frames.hpp"
#include "tests/firmware_io/can/socket_pair.hpp"
#include "tests/pipeline/status/watched_run.hpp"

namespace terracut::health {
namespace {

using can::CanFrame;
using can::CanId;

constexpr std::int64_t kMs = status::WatchedRun::kMs;

class HealthReporterTest : public testing::Test {
 protected:
  void SetUp() override {
    auto source = can::SocketCanSource::adopt(std::move(bus_.there), {.ids = {kHealthId}}, memory_);
    ASSERT_TRUE(source);
    vehicle_.emplace(*std::move(source));
  }
  /// What the vehicle hears now.
  std::vector<CanFrame> heard() {
    const auto frames = vehicle_->receive(0);
    std::vector<CanFrame> copies(frames.begin(), frames.end());
    for (CanFrame& frame : copies) frame.stamp_ns = 0;
    return copies;
  }
  static std::uint32_t alive(const CanFrame& totals) { return totals.data[7]; }

  test::SocketPair bus_, bus_of_view_;
  memory::FixedMemory memory_;
  std::optional<can::SocketCanSource> vehicle_;
  status::WatchedRun run_;
  HealthReporter reporter_{"can1", can::CanSender::adopt(std::move(bus_.here))};
};

TEST_F(HealthReporterTest, ReportsEveryNewFrameOnce) {
  status::FrameRecord newest = run_.newest();
  newest.info.deskew.state = frame::DeskewState::kDone;
  reporter_.work_round(run_.figures(), newest, 0);
  HealthReport report = health_report_of(run_.figures(), newest);
  EXPECT_TRUE(report.ego_motion);
  const auto expected = health_frames(report);
  EXPECT_EQ(heard(), std::vector(expected.begin(), expected.end()));

  reporter_.work_round(run_.figures(), newest, 50 * kMs);
  EXPECT_TRUE(heard().empty()) << "no frame since";
  ++run_.figures().frames;
  ++newest.info.number;
  reporter_.work_round(run_.figures(), newest, 100 * kMs);
  const auto next = heard();
  ASSERT_EQ(next.size(), 2U);
  EXPECT_EQ(next[0].data[0], newest.info.number);
  EXPECT_EQ(alive(next[1]), 1U);
}

TEST_F(HealthReporterTest, TellsTheSensorsViewWhereItIsWatched) {
  auto source = can::SocketCanSource::adopt(
      std::move(bus_of_view_.there), {.ids = {kHealthId, {kHealthId.number + 2, false}}}, memory_);
  ASSERT_TRUE(source);
  HealthReporter reporter("can1", can::CanSender::adopt(std::move(bus_of_view_.here)));
  reporter.work_round(run_.figures(), run_.newest(), 0);
  run_.figures().sight.is_watched = 1;
  ++run_.figures().frames;
  reporter.work_round(run_.figures(), run_.newest(), 0);
  const auto frames = source->receive(0);
  ASSERT_EQ(frames.size(), 5U) << "two of the first report, three of the second";
  EXPECT_EQ(frames[4].id.number, kHealthId.number + 2);
  EXPECT_EQ(alive(frames[4]), 1U);
}

TEST_F(HealthReporterTest, GoesOnReportingWhereNoFramesCome) {
  run_.figures().link = status::LinkState::kSilent;
  std::uint32_t reports = 0;
  for (std::int64_t now_ms = 0; now_ms < 10'000; now_ms += 50) {
    reporter_.work_round(run_.figures(), run_.newest(), now_ms * kMs);
    for (const CanFrame& frame : heard()) {
      if (frame.id != kHealthId) {
        EXPECT_EQ(alive(frame), reports++ % 256);
      }
    }
  }
  EXPECT_EQ(reports, 40U) << "four a second";
}

TEST_F(HealthReporterTest, LeavesOutAndCountsWhatABusyBusDoesNotTake) {
  for (int i = 0; i < 10'000; ++i) {
    ++run_.figures().frames;
    reporter_.work_round(run_.figures(), run_.newest(), 0);
  }
  status::HealthFigures figures;
  reporter_.show(figures);
  EXPECT_EQ(figures.bus.view(), "can1");
  EXPECT_GT(figures.sent, 0U);
  EXPECT_GT(figures.queue_full, 0U);
  EXPECT_EQ(figures.sent + figures.queue_full, 20'000U);
  EXPECT_EQ(figures.link_down + figures.failed, 0U);
}

TEST(HealthReporter, CountsWhatItCouldNotSayWhileItsInterfaceIsNotThere) {
  auto sender = can::CanSender::open("nosuchcan0", true);
  ASSERT_TRUE(sender) << sender.error().message;
  EXPECT_FALSE(sender->has_interface());
  HealthReporter reporter("nosuchcan0", *std::move(sender));
  status::WatchedRun run;
  reporter.work_round(run.figures(), run.newest(), 0);
  status::HealthFigures figures;
  reporter.show(figures);
  EXPECT_EQ(figures.link_down, 2U);
  EXPECT_EQ(figures.sent, 0U);
  EXPECT_EQ(can::CanSender::open("nosuchcan0").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace terracut::health
