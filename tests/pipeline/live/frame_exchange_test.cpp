// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/live/frame_exchange.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "pipeline/live/frame_records.hpp"

namespace terracut::live {
namespace {

class FrameExchangeTest : public testing::Test {
 protected:
  FrameExchangeTest() {
    for (std::size_t i = 0; i < FrameExchange::kBuffers; ++i) {
      buffers_.emplace_back(frame::ImageShape{1, 16}, 8, 0, memory_);
    }
    exchange_.emplace(buffers_);
    open_ = {&buffers_[0], &buffers_[1]};
  }

  /// The frame goes over in the older of the two open buffers; the numbers of those skipped.
  void hand_over(std::uint32_t number) {
    run::Frame frame;
    frame.returns = open_[0];
    frame.record.info.number = number;
    open_[0] = open_[1];
    open_[1] = exchange_->hand_over(frame, [this](const run::Frame& skipped) noexcept {
      skipped_.push_back(skipped.record.info.number);
    });
  }

  memory::FixedMemory memory_;
  std::vector<frame::MeasuredReturns> buffers_;
  std::optional<FrameExchange> exchange_;
  std::array<frame::MeasuredReturns*, 2> open_{};
  std::vector<std::uint32_t> skipped_;
};

TEST_F(FrameExchangeTest, GivesTheNewestFrameAndTellsOfThoseThatWereNeverTaken) {
  EXPECT_EQ(exchange_->take_if_new(), nullptr);
  hand_over(1);
  EXPECT_TRUE(skipped_.empty()) << "it may still be taken";
  hand_over(2);
  EXPECT_EQ(skipped_, (std::vector<std::uint32_t>{1}));
  run::Frame* frame = exchange_->take_if_new();
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->record.info.number, 2U);
  EXPECT_EQ(exchange_->take_if_new(), nullptr) << "it was had";
  hand_over(3);
  EXPECT_EQ(skipped_, (std::vector<std::uint32_t>{1})) << "the one before it was taken";
}

TEST_F(FrameExchangeTest, LeavesEveryFrameEitherTakenOrSkipped) {
  std::vector<std::uint32_t> taken;
  for (std::uint32_t number = 0; number < 100; ++number) {
    hand_over(number);
    if (number % 7 < 3) taken.push_back(exchange_->take_if_new()->record.info.number);
  }
  if (run::Frame* last = exchange_->take_if_new()) taken.push_back(last->record.info.number);
  EXPECT_EQ(taken.size() + skipped_.size(), 100U);
  std::set<std::uint32_t> all(taken.begin(), taken.end());
  all.insert(skipped_.begin(), skipped_.end());
  EXPECT_EQ(all.size(), 100U);
}

TEST_F(FrameExchangeTest, NeverGivesBackABufferThatSomebodyHas) {
  const frame::MeasuredReturns* read = nullptr;
  for (std::uint32_t number = 0; number < 100; ++number) {
    hand_over(number);
    EXPECT_NE(open_[1], read);
    EXPECT_NE(open_[1], open_[0]);
    if (number % 3 == 0) read = exchange_->take_if_new()->returns;
    EXPECT_NE(read, open_[0]);
    EXPECT_NE(read, open_[1]);
  }
}

TEST(FrameRecordsTest, CountsRecordsThatNobodyTookInTime) {
  memory::FixedMemory memory;
  FrameRecords records(memory);
  for (std::uint32_t number = 0; number < FrameRecords::kRoom + 6; ++number) {
    status::FrameRecord record;
    record.info.number = number;
    records.pass_on(record);
  }
  EXPECT_EQ(records.dropped(), 6U);
  status::FrameRecord record;
  for (std::uint32_t number = 0; number < FrameRecords::kRoom; ++number) {
    ASSERT_TRUE(records.take(record));
    EXPECT_EQ(record.info.number, number);
  }
  EXPECT_FALSE(records.take(record));
}

}  // namespace
}  // namespace terracut::live
