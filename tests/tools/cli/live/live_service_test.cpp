// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/live/live_service.hpp"

#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <vector>

#include "service_manager.hpp"

namespace terracut::cli {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// The figures of a run after so many packets and frames.
class Watchdog : public testing::Test {
 protected:
  const status::MonitorSnapshot& figures(std::uint64_t packets, std::uint64_t on_time,
                                         std::uint64_t missed = 0, std::uint64_t unjudged = 0) {
    figures_->packets = packets;
    figures_->frames = on_time + missed + unjudged;
    figures_->unjudged = unjudged;
    figures_->misses[0] = missed;
    return *figures_;
  }
  bool may_feed(std::uint64_t packets, std::uint64_t on_time, std::uint64_t missed = 0,
                std::uint64_t unjudged = 0) {
    return rule_.may_feed(figures(packets, on_time, missed, unjudged));
  }

  status::WatchdogRule rule_;
  std::unique_ptr<status::MonitorSnapshot> figures_ = std::make_unique<status::MonitorSnapshot>();
};

TEST_F(Watchdog, IsFedWhileFramesMeetTheirDeadline) {
  EXPECT_TRUE(may_feed(1000, 10));
  EXPECT_TRUE(may_feed(2000, 19, 1)) << "one late frame";
  EXPECT_FALSE(may_feed(3000, 20, 10)) << "mostly late";
  EXPECT_FALSE(may_feed(4000, 20, 20)) << "all late";
  EXPECT_TRUE(may_feed(5000, 30, 20)) << "recovered";
}

TEST_F(Watchdog, IsNotFedWhenPacketsBecomeNoFrames) {
  EXPECT_TRUE(may_feed(1000, 10));
  EXPECT_FALSE(may_feed(2000, 10));
  EXPECT_FALSE(may_feed(3000, 10, 0, 10)) << "frames of which nobody knows whether they were late";
}

TEST_F(Watchdog, IsNotFedWhenEveryFrameIsSkippedAndHasNoStamp) {
  EXPECT_TRUE(may_feed(1000, 10));
  (void)figures(2000, 10, 10, 10);
  figures_->frames = 20;
  EXPECT_FALSE(rule_.may_feed(*figures_));
}

TEST_F(Watchdog, IsFedWhileTheSensorIsOff) {
  EXPECT_TRUE(may_feed(0, 0));
  EXPECT_TRUE(may_feed(1000, 10));
  EXPECT_TRUE(may_feed(1000, 10));
}

TEST_F(Watchdog, IsFedWhileTheHeadStands) {
  EXPECT_TRUE(may_feed(1000, 10));
  figures_->head_stands = true;
  EXPECT_TRUE(may_feed(2000, 10)) << "a restart would not make it rotate";
  figures_->head_stands = false;
  EXPECT_FALSE(may_feed(3000, 10));
}

class RunAsService : public Service {
 protected:
  /// All messages since the last call.
  [[nodiscard]] std::vector<std::string> all_heard() const {
    std::vector<std::string> all;
    for (std::string one = heard(); !one.empty(); one = heard()) all.push_back(one);
    return all;
  }

  std::unique_ptr<status::MonitorSnapshot> figures_ = std::make_unique<status::MonitorSnapshot>();
};

TEST_F(RunAsService, SaysWhenItIsReadyAndWhenItStops) {
  listen((folder_ / "n").string());
  LiveService service = LiveService::from_environment();
  figures_->sensor = {"HDL-64E at 192.168.1.201"};
  service.ready(*figures_, 0);
  EXPECT_THAT(all_heard(),
              testing::ElementsAre("READY=1\nSTATUS=HDL-64E at 192.168.1.201: link waiting, 0 "
                                   "frames, 0 missed their deadline"));
  service.stopping();
  EXPECT_THAT(all_heard(), testing::ElementsAre("STOPPING=1"));
}

TEST_F(RunAsService, LooksFourTimesWithinTheWatchdogsTime) {
  listen((folder_ / "n").string());
  ::setenv("WATCHDOG_USEC", "10000000", 1);
  LiveService service = LiveService::from_environment();
  service.ready(*figures_, 5 * kSecond_ns);
  (void)all_heard();
  int fed = 0;
  for (int tenths = 51; tenths <= 150; ++tenths) {
    service.work_round(*figures_, tenths * kSecond_ns / 10);
    for (const std::string& message : all_heard()) fed += message == "WATCHDOG=1" ? 1 : 0;
  }
  EXPECT_EQ(fed, 4);
}

TEST_F(RunAsService, LeavesTheWatchdogHungryWhileFramesAreLate) {
  listen((folder_ / "n").string());
  ::setenv("WATCHDOG_USEC", "10000000", 1);
  LiveService service = LiveService::from_environment();
  service.ready(*figures_, 0);
  (void)all_heard();
  figures_->link = status::LinkState::kReceiving;
  figures_->frames_per_s = 9.96;
  figures_->packets = 8700;
  figures_->frames = 25;
  figures_->misses[0] = 20;
  service.work_round(*figures_, 3 * kSecond_ns);
  EXPECT_THAT(all_heard(),
              testing::ElementsAre("STATUS=: 10.0 frames/s, 25 frames, 20 missed their deadline"));
}

TEST_F(RunAsService, SaysThatTheHeadStands) {
  listen((folder_ / "n").string());
  LiveService service = LiveService::from_environment();
  figures_->sensor = {"HDL-64E"};
  figures_->link = status::LinkState::kReceiving;
  figures_->head_stands = true;
  service.ready(*figures_, 0);
  EXPECT_THAT(all_heard(), testing::ElementsAre(testing::HasSubstr("its head does not rotate")));
}

TEST_F(RunAsService, GoesOnWithoutAManagerThatCannotBeReached) {
  ::setenv("NOTIFY_SOCKET", (folder_ / "absent").c_str(), 1);
  testing::internal::CaptureStderr();
  LiveService service = LiveService::from_environment();
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("cannot be reached"));
  service.ready(*figures_, 0);
  service.work_round(*figures_, 60 * kSecond_ns);
  service.stopping();
}

}  // namespace
}  // namespace terracut::cli
