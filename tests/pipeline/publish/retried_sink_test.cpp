// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/publish/retried_sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace terracut::publish {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// What a test and the outputs that are opened share.
struct Door {
  bool can_be_opened = true, throws = false, fails = false;
  int opened = 0, frames = 0, finished = 0;
  std::vector<std::string> news;
};

class SinkBehindDoor final : public FrameSink {
 public:
  explicit SinkBehindDoor(Door& door) : door_(door) {}
  [[nodiscard]] std::string_view name() const noexcept override { return "door"; }
  [[nodiscard]] Status put(const LabelledFrame&) override {
    if (door_.fails) return fail(ErrorCode::kWriteFailed, "no room");
    ++door_.frames;
    ++turned_away_;
    return {};
  }
  [[nodiscard]] Status finish() override {
    ++door_.finished;
    return {};
  }
  [[nodiscard]] std::vector<status::NamedCount> losses() const override {
    return {{{"door_turned_away"}, turned_away_}};
  }

 private:
  Door& door_;
  std::uint64_t turned_away_ = 0;
};

class RetriedSinkTest : public testing::Test {
 protected:
  [[nodiscard]] RetriedSink sink(std::chrono::nanoseconds again_after, bool is_to_be_whole) {
    return RetriedSink({.name = "door",
                        .inner = {.open = [this] { return open(); },
                                  .on_news =
                                      [this](const Status& now) {
                                        door_.news.push_back(now ? "again" : now.error().message);
                                      },
                                  .again_after = again_after},
                        .is_to_be_whole = is_to_be_whole});
  }
  [[nodiscard]] Expected<std::unique_ptr<FrameSink>> open() {
    if (door_.throws) throw std::runtime_error("no more threads");
    if (!door_.can_be_opened) return fail(ErrorCode::kInvalidArgument, "port is taken");
    ++door_.opened;
    return std::make_unique<SinkBehindDoor>(door_);
  }
  static void put(RetriedSink& sink, int frames) {
    for (int n = 0; n < frames; ++n) EXPECT_TRUE(sink.put({}));
  }
  static std::map<std::string, std::uint64_t> losses(const RetriedSink& sink) {
    std::map<std::string, std::uint64_t> losses;
    for (const status::NamedCount& loss : sink.losses()) {
      losses[std::string(loss.name.view())] = loss.count;
    }
    return losses;
  }

  Door door_;
};

constexpr std::chrono::nanoseconds kAtOnce{0};

TEST_F(RetriedSinkTest, IsLikeWhatItOpensWhereThatWorks) {
  RetriedSink retried = sink(kAtOnce, true);
  EXPECT_EQ(door_.opened, 0) << "on the output's own thread";
  put(retried, 3);
  EXPECT_TRUE(retried.finish());
  EXPECT_EQ(door_.opened, 1);
  EXPECT_EQ(door_.frames, 3);
  EXPECT_EQ(door_.finished, 1);
  EXPECT_THAT(door_.news, IsEmpty());
  EXPECT_EQ(losses(retried)["door_frames_while_closed"], 0U);
}

TEST_F(RetriedSinkTest, OpensAsSoonAsThatIsPossible) {
  door_.can_be_opened = false;
  RetriedSink retried = sink(kAtOnce, false);
  put(retried, 3);
  EXPECT_THAT(door_.news, ElementsAre("port is taken")) << "said once";
  door_.can_be_opened = true;
  put(retried, 2);
  EXPECT_EQ(door_.frames, 2);
  EXPECT_THAT(door_.news, ElementsAre("port is taken", "again"));
  EXPECT_EQ(losses(retried)["door_frames_while_closed"], 3U);
  EXPECT_TRUE(retried.finish()) << "nobody expects what was before";
}

TEST_F(RetriedSinkTest, CountsTheSectorsThatCameWhileItWasClosed) {
  door_.can_be_opened = false;
  RetriedSink retried({.name = "door",
                       .wants_sectors = true,
                       .inner = {.open = [this] { return open(); },
                                 .on_news = [](const Status&) {},
                                 .again_after = kAtOnce}});
  for (int n = 0; n < 4; ++n) EXPECT_TRUE(retried.put_sector({}));
  EXPECT_EQ(losses(retried)["door_sectors_while_closed"], 4U);
  EXPECT_EQ(losses(retried)["door_frames_while_closed"], 0U);
}

TEST_F(RetriedSinkTest, OpensAnewWhatHasFailedAndGoesOnCountingItsLosses) {
  RetriedSink retried = sink(kAtOnce, true);
  put(retried, 2);
  door_.fails = true;
  put(retried, 1);
  door_.fails = false;
  put(retried, 3);
  EXPECT_EQ(door_.opened, 2);
  EXPECT_EQ(door_.frames, 5);
  EXPECT_THAT(door_.news, ElementsAre("no room", "again"));
  EXPECT_EQ(losses(retried)["door_turned_away"], 5U);
  EXPECT_EQ(losses(retried)["door_frames_while_closed"], 1U);
  const Status finished = retried.finish();
  ASSERT_FALSE(finished) << "a recording is not whole";
  EXPECT_EQ(finished.error().message, "1 frames are missing in what was written");
}

TEST_F(RetriedSinkTest, TakesAnExceptionForARefusal) {
  door_.throws = true;
  RetriedSink retried = sink(kAtOnce, false);
  put(retried, 1);
  EXPECT_THAT(door_.news, ElementsAre("no more threads"));
}

TEST_F(RetriedSinkTest, DoesNotTryAgainBeforeItsTime) {
  door_.can_be_opened = false;
  RetriedSink retried = sink(std::chrono::hours(24), false);
  put(retried, 1);
  door_.can_be_opened = true;
  put(retried, 10);
  EXPECT_EQ(door_.opened, 0);
  EXPECT_EQ(losses(retried)["door_frames_while_closed"], 11U);
}

}  // namespace
}  // namespace terracut::publish
