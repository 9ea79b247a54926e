// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "firmware_io/bag/cdr_reader.hpp"
#include "firmware_io/bag/packet_messages.hpp"
#include "firmware_io/bag/transform_tree.hpp"

namespace terracut::bag {
namespace {

using testing::ElementsAre;

std::vector<std::byte> bytes_of(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

TEST(CdrReader, ReadsNumbersOfEitherByteOrderAtTheirAlignment) {
  const auto little = bytes_of({0, 1, 0, 0, 7, 99, 99, 99, 1, 2, 0, 0});
  CdrReader from(little);
  EXPECT_EQ(from.number<std::uint8_t>(), 7);
  EXPECT_EQ(from.number<std::uint32_t>(), 513U);
  EXPECT_FALSE(from.failed());
  const auto big = bytes_of({0, 0, 0, 0, 7, 99, 99, 99, 0, 0, 2, 1});
  CdrReader from_big(big);
  EXPECT_EQ(from_big.number<std::uint8_t>(), 7);
  EXPECT_EQ(from_big.number<std::uint32_t>(), 513U);
  EXPECT_FALSE(from_big.failed());
}

TEST(CdrReader, RefusesLengthsThatTheMessageCannotHold) {
  const auto message = bytes_of({0, 1, 0, 0, 255, 255, 255, 255, 1, 2});
  EXPECT_EQ(CdrReader(message).text(), "");
  CdrReader sequence(message);
  EXPECT_TRUE(sequence.byte_sequence().empty());
  EXPECT_TRUE(sequence.failed());
  CdrReader elements(message);
  EXPECT_EQ(elements.length(1), 0U);
  EXPECT_TRUE(elements.failed());
  EXPECT_EQ(elements.number<std::uint8_t>(), 0) << "nothing is read after a fault";
}

TEST(CdrReader, RefusesOtherSerialisations) {
  EXPECT_TRUE(CdrReader(bytes_of({0, 3, 0, 0})).failed()) << "parameter lists";
  EXPECT_TRUE(CdrReader(bytes_of({0, 7, 0, 0})).failed()) << "version 2";
  EXPECT_TRUE(CdrReader(bytes_of({0, 1})).failed());
}

TEST(PacketMessages, GiveThePacketsBeforeAFault) {
  // A header (1 s, frame ""), two packets; of the second a byte is missing.
  const auto message =
      bytes_of({0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0,
                0, 4, 0, 0, 0, 4, 0, 0, 0, 9, 9, 9, 9, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 8});
  std::vector<PacketInMessage> packets;
  EXPECT_FALSE(read_packets("nebula_msgs/msg/NebulaPackets", {0, 5, {}, message}, packets));
  ASSERT_EQ(packets.size(), 1U);
  EXPECT_EQ(packets[0].stamp_ns, 3'000'000'004);
  EXPECT_THAT(packets[0].payload, ElementsAre(9, 9, 9, 9));
}

TEST(PacketMessages, HaveTheMessagesStampWithoutTheirOwn) {
  const auto message = bytes_of({0, 1, 0, 0, 2, 0, 0, 0, 7, 8});
  std::vector<PacketInMessage> packets;
  EXPECT_TRUE(read_packets("ouster_sensor_msgs/msg/PacketMsg", {0, 5, {}, message}, packets));
  ASSERT_EQ(packets.size(), 1U);
  EXPECT_EQ(packets[0].stamp_ns, 5);
}

TEST(PacketMessages, OfRslidarPacketsHaveTheHeadersStamp) {
  // A header (1 s and 2 ns, frame ""), two flags, three bytes.
  const auto message =
      bytes_of({0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 0, 7, 8, 9});
  std::vector<PacketInMessage> packets;
  EXPECT_TRUE(read_packets("rslidar_msg/msg/RslidarPacket", {0, 5, {}, message}, packets));
  ASSERT_EQ(packets.size(), 1U);
  EXPECT_EQ(packets[0].stamp_ns, 1'000'000'002);
  EXPECT_THAT(packets[0].payload, ElementsAre(7, 8, 9));
}

/// Makes a message of one transform.
std::vector<std::byte> transform(char parent, char child, std::array<double, 7> pose) {
  auto message = bytes_of({0, 1, 0, 0, 1,      0, 0, 0, 0, 0, 0, 0, 0,     0, 0, 0,
                           2, 0, 0, 0, parent, 0, 0, 0, 2, 0, 0, 0, child, 0, 0, 0});
  message.resize(message.size() + (message.size() - 4) % 8);
  const auto values = std::as_bytes(std::span(pose));
  message.insert(message.end(), values.begin(), values.end());
  return message;
}

TEST(TransformTree, JoinsFramesByTheirCommonAncestor) {
  TransformTree tree;
  const double half = std::sqrt(0.5);  // a quarter turn to the left
  tree.add(transform('a', 'b', {1, 0, 2, 0, 0, half, half}));
  tree.add(transform('a', 'c', {0, 0, 1, 0, 0, 0, 1}));
  const auto T = tree.transform("b", "c");
  ASSERT_TRUE(T);
  const auto point = mount::apply(*T, 1, 0, 0);
  EXPECT_NEAR(point[0], 1, 1e-12);
  EXPECT_NEAR(point[1], 1, 1e-12);
  EXPECT_NEAR(point[2], 1, 1e-12);
  EXPECT_FALSE(tree.transform("b", "d"));
  EXPECT_THAT(tree.frames(), ElementsAre("a", "b", "c"));
}

TEST(TransformTree, TakesNoTransformThatContradictsAnother) {
  TransformTree tree;
  tree.add(transform('a', 'b', {1, 0, 2, 0, 0, 0, 1}));
  tree.add(transform('a', 'b', {1, 0, 2, 0, 0, 0, 1}));
  EXPECT_TRUE(tree.transform("b", "a")) << "a split bag repeats its transforms";
  tree.add(transform('a', 'b', {1, 0, 3, 0, 0, 0, 1}));
  EXPECT_FALSE(tree.transform("b", "a"));
}

TEST(TransformTree, KeepsTheNewestThatIsSetAndNoneThatIsNotFinite) {
  TransformTree tree;
  tree.set("a", "/b", {0, 0, 1}, {0, 0, 0, 1});
  tree.set("a", "b", {0, 0, 2}, {0, 0, 0, 2});
  tree.set("a", "b", {0, 0, 3}, {0, 0, 0, 0});
  const auto T = tree.transform("b", "a");
  ASSERT_TRUE(T);
  EXPECT_EQ((*T)[11], 2);
}

TEST(TransformTree, TurnsPointsAsTheQuaternionDoes) {
  std::mt19937 random(5);
  std::normal_distribution<double> any;
  for (int n = 0; n < 20; ++n) {
    const std::array<double, 4> xyzw{any(random), any(random), any(random), any(random)};
    const std::array<double, 3> v{any(random), any(random), any(random)};
    TransformTree tree;
    tree.set("a", "b", {1, 2, 3}, xyzw);
    const auto T = tree.transform("b", "a");
    ASSERT_TRUE(T);
    const auto turned = mount::apply(*T, v[0], v[1], v[2]);
    // v + 2 u x (u x v + w v), u and w those of the unit quaternion.
    const double norm = std::hypot(std::hypot(xyzw[0], xyzw[1]), std::hypot(xyzw[2], xyzw[3]));
    const auto cross = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
      return std::array{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                        a[0] * b[1] - a[1] * b[0]};
    };
    const std::array u{xyzw[0] / norm, xyzw[1] / norm, xyzw[2] / norm};
    auto inner = cross(u, v);
    for (std::size_t i = 0; i < 3; ++i) inner[i] += xyzw[3] / norm * v[i];
    const auto half = cross(u, inner);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(turned[i], v[i] + 2 * half[i] + 1.0 + static_cast<double>(i), 1e-12);
    }
  }
}

TEST(TransformTree, FollowsNoCircle) {
  TransformTree tree;
  tree.add(transform('a', 'b', {1, 0, 2, 0, 0, 0, 1}));
  tree.add(transform('b', 'a', {1, 0, 2, 0, 0, 0, 1}));
  EXPECT_FALSE(tree.transform("a", "x"));
}

}  // namespace
}  // namespace terracut::bag
