// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/points/labelled_points.hpp"

#include <gtest/gtest.h>

#include "firmware_io/frame/each_return.hpp"
#include "firmware_io/frame/point_image.hpp"
#include "pipeline/output/label_sink.hpp"
#include "tests/firmware_io/frame/plain_tiles.hpp"
#include "tests/pipeline/output/small_frame.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/synthetic_frame.hpp"

namespace terracut::points {
namespace {

using frame::Label;

/// As a real-time thread calls it: Clang 20 and later refuse what could block.
bool pack_in_real_time(const frame::RangeImage& image, std::span<const Label> labels,
                       std::span<LabelledPoint> points) noexcept TERRACUT_NONBLOCKING {
  return pack_labelled_points(image, labels, points);
}

TEST(LabelledPoints, AreInOrderOfArrivalWithTheOverflowList) {
  output::SmallFrame small;
  small.add(3, 9, 1.0F, 2.0F, 3.0F, Label::kObstacle, 200);
  small.add(0, 31, 4.0F, 5.0F, 0.5F, Label::kGround, 17);
  small.add(3, 9, 6.0F, 7.0F, 8.0F, Label::kObstacle, 1);  // the cell is taken: overflow list
  std::vector<LabelledPoint> points(4);
  ASSERT_TRUE(pack_labelled_points(small.image, small.labels, points));
  EXPECT_EQ(points[0], (LabelledPoint{1.0F, 2.0F, 3.0F, 200, Label::kObstacle, 3}));
  EXPECT_EQ(points[1], (LabelledPoint{4.0F, 5.0F, 0.5F, 17, Label::kGround, 0}));
  EXPECT_EQ(points[2], (LabelledPoint{6.0F, 7.0F, 8.0F, 1, Label::kObstacle, 3}));
  EXPECT_EQ(points[3], LabelledPoint{}) << "nothing is written beyond the returns";
}

TEST(LabelledPoints, OfAWholeFrameAreThoseOfTheImageOneByOne) {
  memory::FixedMemory memory;
  frame::RangeImage image({.rows = 64, .columns = 2083}, 64, memory);
  test::cast_frame(test::even_profile(), test::ground_with_wall(10, 5, 2), image);
  std::vector<Label> labels(image.returns());
  for (std::size_t n = 0; n < labels.size(); ++n) {
    labels[n] = n % 3 == 0 ? Label::kObstacle : Label::kGround;
  }
  std::vector<LabelledPoint> points(image.return_capacity());
  ASSERT_TRUE(pack_labelled_points(image, labels, points));
  std::size_t wrong = 0;
  frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
    const LabelledPoint expected{placed.point.x_m,
                                 placed.point.y_m,
                                 placed.point.z_m,
                                 placed.point.intensity,
                                 labels[placed.return_index],
                                 static_cast<std::uint16_t>(placed.row)};
    if (points[placed.return_index] != expected) ++wrong;
  });
  EXPECT_GT(image.returns(), 100'000U);
  EXPECT_EQ(wrong, 0U);
}

TEST(LabelledPoints, HaveTheTimeAtWhichTheHeadSentTheirBeam) {
  output::SmallFrame small;
  const int columns = small.image.shape().columns;
  small.add(0, 0, 1.0F, 2.0F, 3.0F, Label::kGround);
  small.add(0, columns / 2, 1.0F, 2.0F, 3.0F, Label::kGround);
  small.add(1, columns / 2, 1.0F, 2.0F, 3.0F, Label::kGround);
  small.add(1, columns / 2, 1.0F, 2.0F, 3.0F, Label::kGround);  // overflow list
  const std::vector<float> beam_turns{0.0F, 0.125F, 0.0F, 0.0F};
  frame::FrameInfo info;
  info.first_packet_ns = 1'000'000'000;
  info.last_packet_ns = 1'150'000'000;
  info.head = {-0.25F, 1.25F};  // a revolution takes 100 ms
  std::vector<LabelledPoint> points(4);
  ASSERT_TRUE(
      pack_labelled_points(small.image, small.labels, points, FrameTiming::of(info, beam_turns)));
  const float half_a_column_s = 0.05F / static_cast<float>(columns);
  EXPECT_NEAR(points[0].time_s, 0.025F + half_a_column_s, 1e-6F);
  EXPECT_NEAR(points[1].time_s, 0.075F + half_a_column_s, 1e-6F);
  EXPECT_NEAR(points[2].time_s, 0.0625F + half_a_column_s, 1e-6F)
      << "its beam is ahead of the head";
  EXPECT_EQ(points[3].time_s, points[2].time_s);
}

TEST(LabelledPoints, OfAFrameWithoutReturnsAreNone) {
  output::SmallFrame small;
  EXPECT_TRUE(pack_labelled_points(small.image, {}, {}));
}

TEST(LabelledPoints, AreNotWrittenWhereRoomOrLabelsDoNotFit) {
  output::SmallFrame small;
  small.add(0, 0, 1, 0, 0, Label::kGround);
  small.add(1, 0, 1, 0, 0, Label::kGround);
  std::vector<LabelledPoint> points(2);
  EXPECT_FALSE(pack_labelled_points(small.image, small.labels, std::span(points).first(1)));
  small.labels.push_back(Label::kGround);
  EXPECT_FALSE(pack_labelled_points(small.image, small.labels, points));
  EXPECT_EQ(points[0], LabelledPoint{});
}

TEST(LabelledPoints, ArePackedWithoutAllocation) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer brings its own allocator";
  output::SmallFrame small;
  small.add(0, 0, 1, 0, 0, Label::kGround);
  std::vector<LabelledPoint> points(2);
  const std::uint64_t before = test::allocations_of_this_thread();
  const bool packed = pack_in_real_time(small.image, small.labels, points);
  EXPECT_EQ(test::allocations_of_this_thread(), before);
  EXPECT_TRUE(packed);
}

/// A frame of two tiles, cells with two returns and a missing return, and its labels.
struct PackedTiles : testing::Test {
  static constexpr frame::ImageShape kShape{8, 100};

  PackedTiles() {
    test::PlainTile first(10), second(30);  // the second begins in columns of the first
    for (std::size_t i = 0; i < test::kPlainLasers; ++i) {
      for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
        first.raw[i][f] = static_cast<std::uint16_t>(i == 3 && f % 5 == 0 ? 0 : 100 + 30 * i + f);
        second.raw[i][f] = static_cast<std::uint16_t>(200 + 30 * i + f);
        first.intensity[i][f] = static_cast<std::uint8_t>(i + f);
      }
    }
    EXPECT_EQ(first.add_to(returns, reader), 0U);
    EXPECT_EQ(second.add_to(returns, reader, frame::CellOwner::kFarthest), 0U);
    for (std::uint32_t n = 0; n < returns.returns(); ++n) {
      labels.push_back(n % 3 == 0 ? Label::kObstacle : Label::kGround);
    }
    packed.resize(labels.size());
    expected.resize(labels.size());
  }

  memory::FixedMemory memory;
  test::PlainReader reader;
  frame::MeasuredReturns returns{kShape, test::kPlainLasers, 2, memory};
  frame::PointImage image{kShape, returns.return_capacity(), std::make_unique<test::PlainReader>(),
                          memory};
  std::vector<Label> labels;
  std::vector<LabelledPoint> packed, expected;
};

TEST_F(PackedTiles, AreThePointsOfTheImageMadeOfThem) {
  const std::vector<float> beam_turns{0, 0.01F, 0, -0.01F, 0, 0, 0.02F, 0};
  const FrameTiming timing{{0, 1}, 0.1, beam_turns};
  ASSERT_TRUE(pack_labelled_points(image.make(returns), labels, expected, timing));
  ASSERT_TRUE(pack_labelled_points(returns, {}, reader, labels, packed, timing));
  EXPECT_EQ(packed, expected);
  EXPECT_GT(packed.back().time_s, 0);
}

TEST_F(PackedTiles, AreMovedWhereTheFrameIsDeskewed) {
  const std::vector<float> cosine(100, 0.8F), sine(100, 0.6F), x_m(100, 5), y_m(100, -2);
  const std::vector<frame::PlanarMotions> motions(8, {cosine, sine, x_m, y_m});
  ASSERT_TRUE(pack_labelled_points(image.make(returns, motions), labels, expected));
  ASSERT_TRUE(pack_labelled_points(returns, motions, reader, labels, packed));
  EXPECT_EQ(packed, expected);
}

TEST_F(PackedTiles, ThatDoNotFitAreNotWritten) {
  packed.pop_back();
  EXPECT_FALSE(pack_labelled_points(returns, {}, reader, labels, packed));
  labels.pop_back();
  EXPECT_FALSE(pack_labelled_points(returns, {}, reader, labels, packed));
  EXPECT_EQ(packed, std::vector<LabelledPoint>(packed.size()));
}

}  // namespace
}  // namespace terracut::points
