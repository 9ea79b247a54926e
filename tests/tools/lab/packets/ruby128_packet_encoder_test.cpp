// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/packets/ruby128_packet_encoder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace terracut::packets {
namespace {

constexpr std::size_t kBlockAt[] = {80, 468, 856};

/// 2026-01-02 03:04:05.678901234 UTC
constexpr std::int64_t kStamp_ns = 1'767'323'045'678'901'234;

std::array<Ruby128Column, 3> three_columns() {
  std::array<Ruby128Column, 3> columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    columns[i].stamp_ns = kStamp_ns + static_cast<std::int64_t>(i) * 55'550;
    columns[i].unwrapped_azimuth_cdeg = 3 * 36'000 - 1 + 20 * static_cast<std::int64_t>(i);
  }
  return columns;
}

std::vector<std::uint8_t> encoded(const std::array<Ruby128Column, 3>& columns,
                                  const Ruby128PacketFacts& facts, int first_column = 0) {
  ruby128::ruby128_wire::Packet packet = ruby128::blank_packet();
  encode_ruby128_packet(columns, first_column, facts, packet);
  const auto payload = ruby128::payload_of(packet);
  return {payload.begin(), payload.end()};
}

std::vector<std::uint8_t> bytes(const std::vector<std::uint8_t>& packet, std::size_t from,
                                std::size_t count) {
  return {packet.begin() + static_cast<std::ptrdiff_t>(from),
          packet.begin() + static_cast<std::ptrdiff_t>(from + count)};
}

using Bytes = std::vector<std::uint8_t>;

TEST(Ruby128PacketEncoder, PutsEveryFieldIntoItsBytes) {
  auto columns = three_columns();
  columns[0].by_laser[0] = {0x084B, 77, 40};  // 10.615 m
  columns[1].by_laser[3] = {0x1234, 1, 40};
  columns[2].by_laser[127] = {65'535, 255, 40};
  const Bytes packet = encoded(columns, {.protocol_version = 0x0102, .temperature_deg_c = 18.75});
  ASSERT_EQ(packet.size(), 1248U);
  EXPECT_EQ(bytes(packet, 0, 4), (Bytes{0x55, 0xAA, 0x05, 0x5A}));
  EXPECT_EQ(bytes(packet, 4, 2), (Bytes{0x01, 0x02}));
  EXPECT_EQ(packet[7], 1);  // wave mode: one return
  EXPECT_EQ(bytes(packet, 8, 2), (Bytes{0x12, 0xC0}));
  for (const std::size_t at : kBlockAt) EXPECT_EQ(packet[at], 0xFE);
  EXPECT_EQ(bytes(packet, 82, 2), (Bytes{0x8C, 0x9F}));   // 359.99 degrees
  EXPECT_EQ(bytes(packet, 470, 2), (Bytes{0x00, 0x13}));  // the azimuth wraps
  EXPECT_EQ(bytes(packet, 858, 2), (Bytes{0x00, 0x27}));
  EXPECT_EQ(bytes(packet, 84, 3), (Bytes{0x08, 0x4B, 77}));
  EXPECT_EQ(bytes(packet, 87, 3), (Bytes{0, 0, 0}));  // no return
  EXPECT_EQ(bytes(packet, 468 + 4 + 3 * 3, 3), (Bytes{0x12, 0x34, 1}));
  EXPECT_EQ(bytes(packet, 856 + 4 + 3 * 127, 3), (Bytes{0xFF, 0xFF, 255}));
  EXPECT_EQ(bytes(packet, 1244, 4), (Bytes{0, 0, 0, 0}));
}

TEST(Ruby128PacketEncoder, WritesTheStampOfTheFirstColumnInAnyEncoding) {
  const auto stamp = [](ruby128::RubyTimestamp timestamp) {
    return bytes(encoded(three_columns(), {.timestamp = timestamp}), 10, 10);
  };
  EXPECT_EQ(stamp(ruby128::RubyTimestamp::kCalendar),
            (Bytes{26, 1, 2, 3, 4, 5, 0x02, 0xA6, 0x03, 0x85}));
  // 1767323045 = 0x695735A5; 678901 = 0x000A5BF5; 678901234 = 0x287735F2
  EXPECT_EQ(stamp(ruby128::RubyTimestamp::kUtcMicroseconds),
            (Bytes{0, 0, 0x69, 0x57, 0x35, 0xA5, 0x00, 0x0A, 0x5B, 0xF5}));
  EXPECT_EQ(stamp(ruby128::RubyTimestamp::kUtcNanoseconds),
            (Bytes{0, 0, 0x69, 0x57, 0x35, 0xA5, 0x28, 0x77, 0x35, 0xF2}));
}

TEST(Ruby128PacketEncoder, NumbersTheReturnsOfPairsThatStraddlePackets) {
  const auto numbers = [](int first_column) {
    const Bytes packet = encoded(three_columns(), {.returns = ReturnMode::kDual}, first_column);
    EXPECT_EQ(packet[7], 3);  // wave mode: both returns
    return Bytes{packet[81], packet[469], packet[857]};
  };
  EXPECT_EQ(numbers(0), (Bytes{1, 2, 1}));  // A A B
  EXPECT_EQ(numbers(3), (Bytes{2, 1, 2}));  // B C C
  const Bytes single = encoded(three_columns(), {}, 3);
  EXPECT_EQ((Bytes{single[81], single[469], single[857]}), (Bytes{1, 1, 1}));
}

TEST(Ruby128PacketEncoder, LeavesNothingOfThePacketBefore) {
  auto columns = three_columns();
  columns[1].by_laser[5] = {999, 9, 0};
  ruby128::ruby128_wire::Packet packet = ruby128::blank_packet();
  encode_ruby128_packet(columns, 0, {.returns = ReturnMode::kDual}, packet);
  encode_ruby128_packet(three_columns(), 0, {}, packet);
  const auto payload = ruby128::payload_of(packet);
  EXPECT_EQ(Bytes(payload.begin(), payload.end()), encoded(three_columns(), {}));
}

}  // namespace
}  // namespace terracut::packets
