// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/run/frame_exchange.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "pipeline/run/frame_timings.hpp"

namespace terracut::run {
namespace {

class FrameExchangeTest : public testing::Test {
 protected:
  FrameExchangeTest() {
    for (std::size_t i = 0; i < FrameExchange::kImages; ++i) {
      images_.emplace_back(frame::ImageShape{1, 16}, 0, memory_);
    }
    exchange_.emplace(images_);
    open_ = {&images_[0], &images_[1]};
  }

  /// The frame goes over in the older of the two open images; the numbers of those skipped.
  void hand_over(std::uint32_t number) {
    FrameExchange::Frame frame;
    frame.image = open_[0];
    frame.timing.number = number;
    open_[0] = open_[1];
    open_[1] = exchange_->hand_over(frame, [this](const FrameExchange::Frame& skipped) noexcept {
      skipped_.push_back(skipped.timing.number);
    });
  }

  memory::FixedMemory memory_;
  std::vector<frame::RangeImage> images_;
  std::optional<FrameExchange> exchange_;
  std::array<frame::RangeImage*, 2> open_{};
  std::vector<std::uint32_t> skipped_;
};

TEST_F(FrameExchangeTest, GivesTheNewestFrameAndTellsOfThoseThatWereNeverTaken) {
  EXPECT_EQ(exchange_->take_if_new(), nullptr);
  hand_over(1);
  EXPECT_TRUE(skipped_.empty()) << "it may still be taken";
  hand_over(2);
  EXPECT_EQ(skipped_, (std::vector<std::uint32_t>{1}));
  FrameExchange::Frame* frame = exchange_->take_if_new();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->timing.number, 2U);
  EXPECT_EQ(exchange_->take_if_new(), nullptr) << "it was had";
  hand_over(3);
  EXPECT_EQ(skipped_, (std::vector<std::uint32_t>{1})) << "the one before it was taken";
}

TEST_F(FrameExchangeTest, LeavesEveryFrameEitherTakenOrSkipped) {
  std::vector<std::uint32_t> taken;
  for (std::uint32_t number = 0; number < 100; ++number) {
    hand_over(number);
    if (number % 7 < 3) taken.push_back(exchange_->take_if_new()->timing.number);
  }
  if (FrameExchange::Frame* last = exchange_->take_if_new()) taken.push_back(last->timing.number);
  EXPECT_EQ(taken.size() + skipped_.size(), 100U);
  std::set<std::uint32_t> all(taken.begin(), taken.end());
  all.insert(skipped_.begin(), skipped_.end());
  EXPECT_EQ(all.size(), 100U);
}

TEST_F(FrameExchangeTest, NeverGivesBackAnImageThatSomebodyHas) {
  const frame::RangeImage* read = nullptr;
  for (std::uint32_t number = 0; number < 100; ++number) {
    hand_over(number);
    EXPECT_NE(open_[1], read);
    EXPECT_NE(open_[1], open_[0]);
    if (number % 3 == 0) read = exchange_->take_if_new()->image;
    EXPECT_NE(read, open_[0]);
    EXPECT_NE(read, open_[1]);
  }
}

TEST(FrameTimingsTest, CountsTimesThatNobodyTookInTime) {
  memory::FixedMemory memory;
  FrameTimings timings(memory);
  for (std::uint32_t number = 0; number < FrameTimings::kRoom + 6; ++number) {
    status::FrameTiming timing;
    timing.number = number;
    timings.pass_on(timing);
  }
  EXPECT_EQ(timings.dropped(), 6U);
  status::FrameTiming timing;
  for (std::uint32_t number = 0; number < FrameTimings::kRoom; ++number) {
    ASSERT_TRUE(timings.take(timing));
    EXPECT_EQ(timing.number, number);
  }
  EXPECT_FALSE(timings.take(timing));
}

}  // namespace
}  // namespace terracut::run
