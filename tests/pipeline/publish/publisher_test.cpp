// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/publish/publisher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <future>
#include <mutex>
#include <new>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace terracut::publish {
namespace {

using Numbers = std::vector<std::uint32_t>;

/// What a test and its sink share.
struct Watched {
  std::mutex mutex;
  std::condition_variable changed;
  bool is_open = true;                   ///< Closed: put() waits in it.
  std::size_t closes_behind = SIZE_MAX;  ///< After so many frames.
  bool fails = false, throws = false;
  std::chrono::milliseconds frame_takes{0};  ///< put() takes so long
  Numbers begun, done;
  std::set<const points::LabelledPoint*> rooms;  ///< Where points lay.
  int figures = 0, finished = 0;

  void set_open(bool open) {
    const std::scoped_lock lock(mutex);
    is_open = open;
    changed.notify_all();
  }
  void wait_until(auto condition) {
    std::unique_lock lock(mutex);
    changed.wait(lock, condition);
  }
};

class WatchedSink final : public FrameSink {
 public:
  WatchedSink(std::string name, Watched& watched) : name_(std::move(name)), watched_(watched) {}

  [[nodiscard]] std::string_view name() const noexcept override { return name_; }
  [[nodiscard]] Status put(const LabelledFrame& frame) override {
    std::unique_lock lock(watched_.mutex);
    watched_.begun.push_back(frame.record.info.number);
    watched_.changed.notify_all();
    watched_.changed.wait(lock, [&] { return watched_.is_open; });
    watched_.changed.wait_for(lock, watched_.frame_takes, [] { return false; });
    if (watched_.throws) throw std::bad_alloc();
    if (watched_.fails) return fail(ErrorCode::kWriteFailed, "no room on the disk");
    watched_.rooms.insert(frame.points.data());
    watched_.done.push_back(frame.record.info.number);
    if (watched_.done.size() == watched_.closes_behind) watched_.is_open = false;
    watched_.changed.notify_all();
    return {};
  }
  [[nodiscard]] Status put_figures(const status::MonitorSnapshot&) override {
    const std::scoped_lock lock(watched_.mutex);
    ++watched_.figures;
    watched_.changed.notify_all();
    return {};
  }
  [[nodiscard]] Status finish() override {
    const std::scoped_lock lock(watched_.mutex);
    ++watched_.finished;
    return {};
  }
  [[nodiscard]] std::vector<status::NamedCount> losses() const override {
    return {{{"readers_turned_away"}, 3}};
  }

 private:
  std::string name_;
  Watched& watched_;
};

/// Notes the order of what comes: a frame as its number, a sector as 100 + that of its frame.
class SectorSink final : public FrameSink {
 public:
  explicit SectorSink(Watched& watched) : watched_(watched) {}

  [[nodiscard]] std::string_view name() const noexcept override { return "sectors"; }
  [[nodiscard]] bool wants_sectors() const noexcept override { return true; }
  [[nodiscard]] Status put(const LabelledFrame& frame) override {
    note(frame.record.info.number);
    return {};
  }
  [[nodiscard]] Status put_sector(const LabelledSector& sector) override {
    note(100 + sector.record.frame);
    return {};
  }

 private:
  void note(std::uint32_t number) {
    std::unique_lock lock(watched_.mutex);
    watched_.begun.push_back(number);
    watched_.changed.notify_all();
    watched_.changed.wait(lock, [&] { return watched_.is_open; });
    watched_.done.push_back(number);
    watched_.changed.notify_all();
  }

  Watched& watched_;
};

class PublisherTest : public testing::Test {
 protected:
  Publisher& make(WhenFull when_full) {
    Publisher::Sinks sinks;
    sinks.push_back(std::make_unique<WatchedSink>("slow", slow_));
    sinks.push_back(std::make_unique<WatchedSink>("quick", quick_));
    return publisher_.emplace(std::move(sinks), when_full,
                              [this](std::string_view sink, const Error& error) {
                                said_.push_back(std::string(sink) + ": " + error.message);
                              });
  }
  static void put(Publisher& publisher, std::uint32_t number) {
    const auto frame = publisher.buffer();
    frame->record.info.number = number;
    frame->points.resize(10);
    publisher.put(frame);
  }
  static std::uint64_t loss(const Publisher& publisher, std::string_view name, bool over = false) {
    for (const status::NamedCount& loss : publisher.losses(over)) {
      if (loss.name.view() == name) return loss.count;
    }
    ADD_FAILURE() << "no loss " << name;
    return 0;
  }
  void wait_for_quick(std::size_t frames) {
    quick_.wait_until([&] { return quick_.done.size() == frames; });
  }

  Watched slow_, quick_;
  std::vector<std::string> said_;
  std::optional<Publisher> publisher_;
};

TEST_F(PublisherTest, AnOutputThatStopsLosesTheOldestCountedAndHoldsUpNoOther) {
  Publisher& publisher = make(WhenFull::kDropOldest);
  slow_.set_open(false);
  put(publisher, 0);
  slow_.wait_until([&] { return slow_.begun.size() == 1; });
  for (std::uint32_t number = 1; number < 10; ++number) {
    put(publisher, number);
    wait_for_quick(number + 1);
  }
  EXPECT_EQ(loss(publisher, "slow_frames_left_out"), 7U) << "1 in work, 2 wait";
  EXPECT_EQ(loss(publisher, "slow_frames_left_out", true), 10U) << "if it never goes on";
  EXPECT_EQ(loss(publisher, "quick_frames_left_out"), 0U);
  EXPECT_EQ(loss(publisher, "readers_turned_away"), 3U) << "what outputs count themselves";
  slow_.set_open(true);
  EXPECT_TRUE(publisher.finish(std::nullopt));
  EXPECT_EQ(slow_.done, (Numbers{0, 8, 9}));
  EXPECT_EQ(slow_.finished, 1);
  EXPECT_EQ(loss(publisher, "slow_frames_left_out", true), 7U);
  EXPECT_TRUE(publisher.outcome());
}

TEST_F(PublisherTest, SectorsComeBeforeTheirFrameToWhoeverWantsThem) {
  Publisher::Sinks sinks;
  sinks.push_back(std::make_unique<SectorSink>(slow_));
  sinks.push_back(std::make_unique<WatchedSink>("quick", quick_));
  Publisher publisher(std::move(sinks), WhenFull::kDropOldest, [](auto, const Error&) {});
  EXPECT_TRUE(publisher.wants_sectors());
  const auto put_sector = [&](std::uint32_t frame) {
    const auto sector = std::make_shared<LabelledSector>();
    sector->record.frame = frame;
    publisher.put_sector(sector);
  };
  slow_.set_open(false);
  put_sector(0);
  slow_.wait_until([&] { return slow_.begun.size() == 1; });
  put_sector(0);
  put(publisher, 0);
  put_sector(1);
  put_sector(1);
  put(publisher, 1);
  put_sector(2);
  slow_.set_open(true);
  EXPECT_TRUE(publisher.finish(std::nullopt));
  EXPECT_EQ(slow_.done, (Numbers{100, 100, 0, 101, 101, 1, 102}));
  EXPECT_EQ(quick_.done, (Numbers{0, 1}));
  EXPECT_EQ(loss(publisher, "sectors_sectors_left_out"), 0U);
}

TEST_F(PublisherTest, SectorsThatAnOutputHasNoTimeForAreCountedAndCostItNoFrame) {
  Publisher::Sinks sinks;
  sinks.push_back(std::make_unique<SectorSink>(slow_));
  Publisher publisher(std::move(sinks), WhenFull::kDropOldest, [](auto, const Error&) {});
  slow_.set_open(false);
  put(publisher, 0);
  slow_.wait_until([&] { return slow_.begun.size() == 1; });
  constexpr std::uint32_t kSent = 1000;
  const auto sector = std::make_shared<LabelledSector>();
  sector->record.frame = 1;
  for (std::uint32_t i = 0; i < kSent; ++i) publisher.put_sector(sector);
  put(publisher, 1);
  slow_.set_open(true);
  EXPECT_TRUE(publisher.finish(std::nullopt));
  const auto came = static_cast<std::uint64_t>(std::ranges::count(slow_.done, 101U));
  EXPECT_GT(came, 100U) << "a turn of them";
  EXPECT_EQ(came + loss(publisher, "sectors_sectors_left_out"), kSent);
  EXPECT_EQ(slow_.done.front(), 0U);
  EXPECT_EQ(slow_.done.back(), 1U);
}

TEST_F(PublisherTest, SectorsThatWaitForAnOutputWhichHangsAreLostInTheEnd) {
  Publisher::Sinks sinks;
  sinks.push_back(std::make_unique<SectorSink>(slow_));
  Publisher publisher(std::move(sinks), WhenFull::kDropOldest, [](auto, const Error&) {});
  slow_.set_open(false);
  for (int i = 0; i < 5; ++i) publisher.put_sector(std::make_shared<LabelledSector>());
  slow_.wait_until([&] { return slow_.begun.size() == 1; });
  EXPECT_EQ(loss(publisher, "sectors_sectors_left_out"), 0U);
  EXPECT_EQ(loss(publisher, "sectors_sectors_left_out", true), 5U);
  slow_.set_open(true);
  EXPECT_TRUE(publisher.finish(std::nullopt));
  EXPECT_EQ(loss(publisher, "sectors_sectors_left_out", true), 0U);
}

TEST_F(PublisherTest, OfARecordingNothingIsLostHoweverSlowAnOutputIs) {
  Publisher& publisher = make(WhenFull::kWait);
  slow_.set_open(false);
  auto putting = std::async(std::launch::async, [&] {
    for (std::uint32_t number = 0; number < 50; ++number) put(publisher, number);
  });
  // The slow one has one in work and two waiting; the fourth is being handed to it.
  wait_for_quick(3);
  slow_.set_open(true);
  putting.get();
  EXPECT_TRUE(publisher.finish(std::nullopt));
  EXPECT_EQ(slow_.done.size(), 50U);
  EXPECT_EQ(quick_.done.size(), 50U);
  EXPECT_EQ(loss(publisher, "slow_frames_left_out"), 0U);
}

TEST_F(PublisherTest, AnOutputThatFailsSaysSoOnceAndTheOthersGoOn) {
  for (const WhenFull when_full : {WhenFull::kDropOldest, WhenFull::kWait}) {
    SCOPED_TRACE(static_cast<int>(when_full));
    Publisher& publisher = make(when_full);
    quick_.done.clear();
    said_.clear();
    slow_.fails = true;
    for (std::uint32_t number = 0; number < 10; ++number) {
      put(publisher, number);
      wait_for_quick(number + 1);
    }
    EXPECT_TRUE(publisher.finish(std::nullopt));
    EXPECT_EQ(said_, std::vector<std::string>{"slow: no room on the disk"});
    EXPECT_EQ(loss(publisher, "slow_frames_left_out"), 10U);
    EXPECT_EQ(quick_.done.size(), 10U);
    EXPECT_EQ(slow_.finished, 0) << "nothing more is asked of it";
    ASSERT_FALSE(publisher.outcome());
    EXPECT_EQ(publisher.outcome().error().message, "no room on the disk");
  }
}

TEST_F(PublisherTest, AnOutputThatThrowsHasFailedAndTheOthersGoOn) {
  Publisher& publisher = make(WhenFull::kDropOldest);
  slow_.throws = true;
  for (std::uint32_t number = 0; number < 10; ++number) {
    put(publisher, number);
    wait_for_quick(number + 1);
  }
  EXPECT_TRUE(publisher.finish(std::nullopt));
  ASSERT_EQ(said_.size(), 1U);
  EXPECT_EQ(loss(publisher, "slow_frames_left_out"), 10U);
  EXPECT_FALSE(publisher.outcome());
}

TEST_F(PublisherTest, OneThatNeverAnswersIsGivenUp) {
  Publisher& publisher = make(WhenFull::kDropOldest);
  slow_.set_open(false);
  put(publisher, 0);
  slow_.wait_until([&] { return slow_.begun.size() == 1; });
  EXPECT_FALSE(publisher.finish(std::chrono::milliseconds(1)));
  slow_.set_open(true);
}

TEST_F(PublisherTest, OneThatStopsAnsweringWhileItFinishesIsGivenUp) {
  Publisher& publisher = make(WhenFull::kDropOldest);
  slow_.closes_behind = 1;
  slow_.set_open(false);
  put(publisher, 0);
  slow_.wait_until([&] { return slow_.begun.size() == 1; });
  put(publisher, 1);
  put(publisher, 2);
  slow_.set_open(true);
  EXPECT_FALSE(publisher.finish(std::chrono::milliseconds(50)));
  slow_.wait_until([&] { return !slow_.done.empty(); });
  slow_.set_open(true);
}

TEST_F(PublisherTest, OneThatIsSlowHasItsTimeForEachFrame) {
  Publisher& publisher = make(WhenFull::kDropOldest);
  slow_.frame_takes = std::chrono::milliseconds(1500);
  put(publisher, 0);
  slow_.wait_until([&] { return slow_.begun.size() == 1; });
  put(publisher, 1);
  put(publisher, 2);
  EXPECT_TRUE(publisher.finish(std::chrono::seconds(4))) << "4.5 s in all";
  EXPECT_EQ(slow_.done.size(), 3U);
}

TEST_F(PublisherTest, FramesAreInTheSameFewPlacesAgain) {
  Publisher& publisher = make(WhenFull::kDropOldest);
  for (std::uint32_t number = 0; number < 100; ++number) {
    put(publisher, number);
    wait_for_quick(number + 1);
  }
  EXPECT_TRUE(publisher.finish(std::nullopt));
  EXPECT_LE(quick_.rooms.size(), 5U) << "two wait, two are in work, one is being filled";
}

TEST_F(PublisherTest, FiguresGoToEveryOutput) {
  Publisher& publisher = make(WhenFull::kDropOldest);
  publisher.put_figures(*std::make_unique<status::MonitorSnapshot>());
  for (Watched* each : {&slow_, &quick_}) {
    each->wait_until([&] { return each->figures == 1; });
  }
  EXPECT_TRUE(publisher.finish(std::nullopt));
}

}  // namespace
}  // namespace terracut::publish
