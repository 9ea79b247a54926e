// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/frame_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/firmware_io/frame/plain_tiles.hpp"
#include "tests/support/hand_out.hpp"

namespace terracut::decode {
namespace {

constexpr std::int64_t kRevolution = 3600;
constexpr packet::BeamSpread kSpread{-100, 110};
constexpr std::int64_t kStep = 10;

constexpr std::size_t kTiles = 16;

FrameBuilder::Config small() {
  return {{.rows = 8, .columns = 24}, test::kPlainLasers, kTiles, kRevolution};
}

/// Adds a return of a laser at a column to a frame.
void place(FrameBuilder& builder, std::int64_t frame, std::size_t laser, std::size_t column) {
  test::PlainTile tile(0);
  tile.raw[laser][column] = 1;
  test::PlainReader reader;
  builder.losses().overflow_full_returns += tile.add_to(builder.returns_of(frame), reader);
}

struct Handed {
  frame::FrameInfo info;
  const frame::MeasuredReturns* returns;
};

template <class OnFrame>
void roll_to(FrameBuilder& builder, std::int64_t frame, OnFrame&& on_frame) {
  builder.roll_to(frame);
  test::hand_out(builder, on_frame);
}
template <class OnFrame>
void roll(FrameBuilder& builder, OnFrame&& on_frame) {
  roll_to(builder, builder.oldest() + 1, on_frame);
}
template <class OnFrame>
void flush(FrameBuilder& builder, OnFrame&& on_frame) {
  builder.flush();
  test::hand_out(builder, on_frame);
}

class FrameBuilderTest : public testing::Test {
 protected:
  auto keep() {
    return [this](const frame::FrameInfo& info, const frame::MeasuredReturns& returns) noexcept {
      handed.push_back({info, &returns});
    };
  }
  memory::FixedMemory memory;
  FrameBuilder builder{small(), memory};
  std::vector<Handed> handed;
};

TEST_F(FrameBuilderTest, SortsReturnsIntoTheTwoOpenFrames) {
  builder.start(7, 7 * kRevolution);
  place(builder, 7, 1, 2);
  place(builder, 8, 1, 2);
  place(builder, 8, 1, 3);
  place(builder, 7, 3, 19);
  roll(builder, keep());
  ASSERT_EQ(handed.size(), 1U);
  EXPECT_EQ(handed[0].info.returns, 2U);
  roll(builder, keep());
  ASSERT_EQ(handed.size(), 2U);
  EXPECT_EQ(handed[1].info.returns, 2U);
  EXPECT_EQ(handed[1].info.number, 1U);
}

TEST_F(FrameBuilderTest, AFrameWithoutReturnsIsNoFrame) {
  builder.start(0, 0);
  roll(builder, keep());
  place(builder, 1, 0, 0);
  flush(builder, keep());
  ASSERT_EQ(handed.size(), 1U);
  EXPECT_EQ(handed[0].info.number, 0U);
  EXPECT_FALSE(builder.started());
}

TEST_F(FrameBuilderTest, LeavesABufferAloneUntilTheNextHandOver) {
  builder.start(0, 0);
  for (std::int64_t frame = 0; frame < 20; ++frame) {
    place(builder, frame, 0, 0);
    roll(builder, keep());
    // What comes until then: empty frames, an end, a new start.
    if (frame % 3 == 1) {
      flush(builder, keep());
      builder.start(frame + 1, 0);
    }
    place(builder, frame + 1, 1, 1);
    ASSERT_EQ(handed.back().returns->returns(), handed.back().info.returns);
  }
}

TEST_F(FrameBuilderTest, TurnsHaveNumbersThatFollowExactlyWhereTheyDo) {
  std::vector<std::int64_t> turns;
  const auto note = [&](const frame::FrameInfo&, frame::MeasuredReturns& returns) noexcept {
    turns.push_back(returns.turn());
  };
  builder.start(5, 5 * kRevolution);
  for (const std::int64_t frame : {5, 6, 7}) {
    place(builder, frame, 0, 0);
    roll(builder, note);
  }
  roll(builder, note);  // one without returns
  place(builder, 9, 0, 0);
  flush(builder, note);
  builder.start(2, 2 * kRevolution);  // another stream
  place(builder, 2, 0, 0);
  place(builder, 3, 0, 0);
  flush(builder, note);
  ASSERT_EQ(turns.size(), 6U);
  EXPECT_EQ(turns[1], turns[0] + 1);
  EXPECT_EQ(turns[2], turns[1] + 1);
  EXPECT_EQ(turns[3], turns[2] + 2);
  EXPECT_GT(turns[4], turns[3] + 1);
  EXPECT_EQ(turns[5], turns[4] + 1);
}

TEST_F(FrameBuilderTest, CountsReturnsThatFindNoRoom) {
  builder.start(0, 0);
  for (std::size_t n = 0; n < kTiles + 7; ++n) place(builder, 0, 0, 0);
  flush(builder, keep());
  ASSERT_EQ(handed.size(), 1U);
  EXPECT_EQ(handed[0].info.returns, kTiles);
  EXPECT_EQ(handed[0].info.losses.overflow_full_returns, 7U);
  EXPECT_EQ(builder.total_losses().overflow_full_returns, 7U);
}

TEST_F(FrameBuilderTest, AFrameSeenFromSeamToSeamIsComplete) {
  builder.start(-1, -200);
  place(builder, 0, 0, 0);
  builder.note_packet({5, 0, -1, 0, kRevolution + 100}, kStep, kSpread);
  roll(builder, keep());
  roll(builder, keep());
  ASSERT_EQ(handed.size(), 1U);
  EXPECT_TRUE(handed[0].info.complete);
  EXPECT_EQ(handed[0].info.losses.azimuth_hole_columns, 0U);
}

TEST_F(FrameBuilderTest, AFrameWhoseStartOrEndWasNotSeenIsIncomplete) {
  builder.start(-1, -50);  // the foremost beam was 60 past the seam already
  place(builder, 0, 0, 0);
  builder.note_packet({5, 0, -1, 0, kRevolution + 100}, kStep, kSpread);
  flush(builder, keep());
  builder.start(-1, -200);
  place(builder, 0, 0, 0);
  builder.note_packet({5, 0, -1, 0, kRevolution + 80}, kStep, kSpread);
  flush(builder, keep());
  ASSERT_EQ(handed.size(), 2U);
  EXPECT_FALSE(handed[0].info.complete);
  EXPECT_FALSE(handed[1].info.complete);
}

TEST_F(FrameBuilderTest, AHoleMakesAFrameIncompleteUntilItIsFilled) {
  for (const bool filled : {false, true}) {
    builder.start(-1, -200);
    place(builder, 0, 0, 0);
    builder.lose({1000, 1060}, kSpread, kStep);
    if (filled) builder.regain({1000, 1060}, kSpread);
    builder.note_packet({5, 0, -1, 0, kRevolution + 100}, kStep, kSpread);
    flush(builder, keep());
    EXPECT_EQ(handed.back().info.complete, filled);
    EXPECT_EQ(handed.back().info.losses.azimuth_hole_columns, filled ? 0U : 6U);
  }
}

TEST_F(FrameBuilderTest, AHoleAtTheSeamCountsOnceButSpoilsBothFrames) {
  builder.start(-1, -200);
  place(builder, 0, 0, 0);
  builder.note_packet({5, 0, -1, 0, 0}, kStep, kSpread);
  roll(builder, keep());  // frame -1, without returns
  place(builder, 1, 0, 0);
  builder.lose({kRevolution - 30, kRevolution + 30}, kSpread, kStep);
  builder.note_packet({6, 0, 0, 1, kRevolution + 100}, kStep, kSpread);
  roll(builder, keep());
  builder.note_packet({7, 0, 1, 1, 2 * kRevolution + 100}, kStep, kSpread);
  roll(builder, keep());
  ASSERT_EQ(handed.size(), 2U);
  EXPECT_FALSE(handed[0].info.complete);
  EXPECT_FALSE(handed[1].info.complete);
  EXPECT_EQ(handed[0].info.losses.azimuth_hole_columns, 3U);
  EXPECT_EQ(handed[1].info.losses.azimuth_hole_columns, 3U);
}

TEST_F(FrameBuilderTest, AHoleOverWholeFramesIsCountedInFull) {
  builder.start(0, 0);
  place(builder, 0, 0, 0);
  builder.lose({kRevolution / 2, 3 * kRevolution + kRevolution / 2}, kSpread, kStep);
  for (int n = 0; n < 3; ++n) roll(builder, keep());
  place(builder, 3, 0, 0);
  flush(builder, keep());
  EXPECT_EQ(builder.total_losses().azimuth_hole_columns,
            static_cast<std::uint64_t>(3 * kRevolution / kStep));
}

TEST_F(FrameBuilderTest, KeepsThePacketStampsOfEachFrame) {
  builder.start(0, 0);
  place(builder, 0, 0, 0);
  place(builder, 1, 0, 0);
  builder.note_packet({10, 0, 0, 0, 100}, kStep, kSpread);
  builder.note_packet({20, kRevolution, 0, 1, 200}, kStep, kSpread);
  builder.note_packet({15, kRevolution / 2, 0, 1, 200}, kStep, kSpread);  // out of order
  builder.note_packet({30, 2 * kRevolution, 1, 1, 300}, kStep, kSpread);
  flush(builder, keep());
  ASSERT_EQ(handed.size(), 2U);
  EXPECT_EQ(handed[0].info.first_packet_ns, 10);
  EXPECT_EQ(handed[0].info.last_packet_ns, 20);
  EXPECT_EQ(handed[1].info.first_packet_ns, 15);
  EXPECT_EQ(handed[1].info.last_packet_ns, 30);
  EXPECT_EQ(handed[0].info.head.first_turns, 0.0F);
  EXPECT_EQ(handed[0].info.head.last_turns, 1.0F);
  EXPECT_EQ(handed[1].info.head.first_turns, -0.5F) << "of the frame's own revolution";
  EXPECT_EQ(handed[1].info.head.last_turns, 1.0F);
  EXPECT_EQ(handed[0].info.packets + handed[1].info.packets, 4U);
}

TEST(FrameBuilderConfig, MayHaveOneRowAndOneColumnButNotNone) {
  memory::FixedMemory memory;
  FrameBuilder::Config config = small();
  config.shape = {.rows = 1, .columns = 1};
  EXPECT_NO_THROW(FrameBuilder(config, memory));
  config.shape = {.rows = 0, .columns = 1};
  EXPECT_THROW(FrameBuilder(config, memory), std::invalid_argument);
  config.shape = {.rows = 1, .columns = 0};
  EXPECT_THROW(FrameBuilder(config, memory), std::invalid_argument);
  config.shape = {.rows = 1, .columns = 1};
  config.revolution_ticks = 0;
  EXPECT_THROW(FrameBuilder(config, memory), std::invalid_argument);
}

}  // namespace
}  // namespace terracut::decode
