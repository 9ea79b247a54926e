// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ros_messages/object_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "firmware_io/bag/cdr_reader.hpp"

namespace terracut::ros_messages {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;

/// A box of 4 by 2 by 1.5 m whose longer side points to `direction_rad`.
objects::Object box_turned(double direction_rad) {
  objects::Object object;
  object.bottom_m = 0.25F;
  object.top_m = 1.75F;
  object.ground_z_m = -0.5F;
  object.box = {
      {10, 5},
      {static_cast<float>(std::cos(direction_rad)), static_cast<float>(std::sin(direction_rad))},
      4,
      2};
  object.footprint.corners = {{{9, 4}, {11, 4}, {11, 6}}};
  object.footprint.count = 3;
  return object;
}

TEST(BoxPose, LiesBetweenTheLowestAndTheHighestReturn) {
  const BoxPose box = box_pose(box_turned(0));
  EXPECT_THAT(box.middle_m, ElementsAre(10, 5, 0.5));
  EXPECT_THAT(box.size_m, ElementsAre(4, 2, 1.5));
  EXPECT_THAT(box.rotation_xyzw, ElementsAre(0, 0, 0, 1));
}

TEST(BoxPose, IsTurnedWithTheLongerSideWhicheverWayThatPoints) {
  for (double direction_rad = -6.2; direction_rad < 6.3; direction_rad += 0.1) {
    const auto [x, y, z, w] = box_pose(box_turned(direction_rad)).rotation_xyzw;
    EXPECT_GT(w, 0.7) << direction_rad;
    EXPECT_NEAR(z * z + w * w, 1, 1e-6);
    const double turn_rad = 2 * std::atan2(z, w);
    EXPECT_NEAR(std::sin(turn_rad - direction_rad), 0, 1e-6) << direction_rad;
  }
}

TEST(BoxPose, MovesToTheFrameOfASensorThatIsTilted) {
  // Looks down in front by 90 degrees, 2 m above the ground: its x points down, its z ahead.
  constexpr mount::RigidTransform kTilted{0, 0, -1, 2, 0, 1, 0, 0, 1, 0, 0, 0};
  const BoxPose box = moved(box_pose(box_turned(0)), kTilted);
  EXPECT_THAT(box.middle_m, ElementsAre(1.5, 5, 10));
  EXPECT_THAT(box.size_m, ElementsAre(4, 2, 1.5));
  const double half = std::sqrt(0.5);
  EXPECT_THAT(box.rotation_xyzw, ElementsAre(DoubleNear(0, 1e-9), DoubleNear(-half, 1e-9),
                                             DoubleNear(0, 1e-9), DoubleNear(half, 1e-9)));
}

TEST(BoxPose, StaysAsItIsInTheSameFrame) {
  const BoxPose box = box_pose(box_turned(2)),
                same = moved(box, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  EXPECT_EQ(same.middle_m, box.middle_m);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(same.rotation_xyzw[i], box.rotation_xyzw[i], 1e-6);
  }
}

TEST(ObjectLines, BoxesAreTheTwelveEdgesOfEachBox) {
  const std::array<objects::Object, 2> objects{box_turned(0.3), box_turned(2)};
  const auto lines = object_lines(objects)[0].places_m;
  ASSERT_EQ(lines.size(), 48U);
  std::multiset<int> lengths_cm;
  for (std::size_t i = 0; i < 24; i += 2) {
    const auto &a = lines[i], &b = lines[i + 1];
    lengths_cm.insert(
        static_cast<int>(std::lround(100 * std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]))));
  }
  EXPECT_EQ(lengths_cm,
            (std::multiset<int>{150, 150, 150, 150, 200, 200, 200, 200, 400, 400, 400, 400}));
}

TEST(ObjectLines, FootprintsAreItsSidesOnTheGround) {
  const std::array<objects::Object, 1> objects{box_turned(0)};
  const auto lines = object_lines(objects)[1].places_m;
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[0], (std::array{9.0, 4.0, -0.5}));
  EXPECT_EQ(lines[5], lines[0]) << "closed";
}

TEST(ObjectMessages, AreAsLongAsTheirDefinitionsSay) {
  publish::LabelledFrame frame;
  frame.objects = {box_turned(0), box_turned(1)};
  std::vector<std::byte> message;
  write_detections(frame, "abc", message);
  // A header is 8 + 4 + 4 bytes, an array's length 4. An object: a header, no results, ten numbers
  // of 8 bytes, "1" of 4 + 2. Numbers begin at multiples of their size.
  const std::size_t first = 16 + 4 + (16 + 4) + 80 + 6;
  const std::size_t second = (first + 2) + (16 + 4) + 4 + 80 + 6;
  EXPECT_EQ(message.size(), 4 + second);
}

TEST(ObjectMessages, MarkersAreReadToTheirEndAsVisualizationMsgsDefineThem) {
  publish::LabelledFrame frame;
  frame.objects = {box_turned(0), box_turned(1)};
  std::vector<std::byte> message;
  write_object_markers(frame, "abc", message);
  bag::CdrReader from(message);
  const auto header = [&] {
    (void)from.number<std::int32_t>();
    (void)from.number<std::uint32_t>();
    return from.text();
  };
  std::size_t places = 0;
  for (std::size_t left = from.length(1); left > 0; --left) {
    EXPECT_EQ(header(), "abc");
    EXPECT_FALSE(from.text().empty()) << "its namespace";
    (void)from.number<std::int32_t>();          // id
    EXPECT_EQ(from.number<std::int32_t>(), 5);  // LINE_LIST
    EXPECT_EQ(from.number<std::int32_t>(), 0);  // ADD
    for (int i = 0; i < 6; ++i) EXPECT_EQ(from.number<double>(), 0);
    EXPECT_EQ(from.number<double>(), 1) << "not turned";
    EXPECT_GT(from.number<double>(), 0) << "the lines' width";
    for (int i = 0; i < 2; ++i) EXPECT_EQ(from.number<double>(), 0);
    for (int i = 0; i < 3; ++i) (void)from.number<float>();
    EXPECT_GT(from.number<float>(), 0) << "to be seen";
    EXPECT_EQ(from.number<std::int32_t>(), 0);  // lifetime
    EXPECT_EQ(from.number<std::uint32_t>(), 0U);
    EXPECT_FALSE(from.number<bool>());  // frame_locked
    const std::size_t points = from.length(24);
    for (std::size_t i = 0; i < 3 * points; ++i) (void)from.number<double>();
    places += points;
    EXPECT_EQ(from.length(1), 0U) << "colours";
    EXPECT_EQ(from.text(), "") << "texture";
    EXPECT_EQ(header(), "");
    EXPECT_EQ(from.text(), "");
    EXPECT_EQ(from.length(1), 0U);
    EXPECT_EQ(from.length(1), 0U) << "its coordinates";
    EXPECT_EQ(from.text(), "");
    EXPECT_EQ(from.text(), "") << "mesh";
    EXPECT_EQ(from.text(), "");
    EXPECT_EQ(from.length(1), 0U);
    EXPECT_FALSE(from.number<bool>());
  }
  EXPECT_EQ(places, 2 * (24 + 6U));
  EXPECT_FALSE(from.failed());
  (void)from.bytes(1);
  EXPECT_TRUE(from.failed()) << "nothing follows";
}

}  // namespace
}  // namespace terracut::ros_messages
