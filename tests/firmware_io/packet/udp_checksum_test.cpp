// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/udp_checksum.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace terracut::packet {
namespace {

TEST(InternetChecksum, IsThatOfTheExampleInRfc1071) {
  constexpr std::array<std::uint8_t, 8> kExample{0x00, 0x01, 0xF2, 0x03, 0xF4, 0xF5, 0xF6, 0xF7};
  EXPECT_EQ(internet_checksum(kExample), 0x220D);
}

TEST(InternetChecksum, CountsAnOddLastByteAsIfAZeroFollowed) {
  constexpr std::array<std::uint8_t, 3> kOdd{0x12, 0x34, 0x56};
  constexpr std::array<std::uint8_t, 4> kEven{0x12, 0x34, 0x56, 0x00};
  EXPECT_EQ(internet_checksum(kOdd), internet_checksum(kEven));
  EXPECT_EQ(internet_checksum(kOdd), 0xFFFF - 0x1234 - 0x5600);
}

TEST(UdpChecksum, MakesThePseudoHeaderAndTheDatagramSumToOnes) {
  for (const std::size_t bytes : {0U, 1U, 1206U, 1207U}) {
    std::vector<std::uint8_t> payload(bytes);
    for (std::size_t i = 0; i < bytes; ++i) payload[i] = static_cast<std::uint8_t>(37 * i + 11);
    const Datagram datagram{.payload = payload,
                            .source_address = 0xC0A801C9,
                            .destination_address = 0xFFFFFFFF,
                            .source_port = 2368,
                            .destination_port = 2369};
    const auto length = static_cast<std::uint16_t>(8 + bytes);
    std::vector<std::uint8_t> all;
    const auto put = [&](std::uint32_t value, int count) {
      for (int at = count - 1; at >= 0; --at) {
        all.push_back(static_cast<std::uint8_t>(value >> (8 * at)));
      }
    };
    put(datagram.source_address, 4);
    put(datagram.destination_address, 4);
    put(17, 2);  // the protocol
    put(length, 2);
    put(datagram.source_port, 2);
    put(datagram.destination_port, 2);
    put(length, 2);
    put(udp_checksum(datagram), 2);
    all.insert(all.end(), payload.begin(), payload.end());
    EXPECT_EQ(internet_checksum(all), 0) << bytes;
  }
}

}  // namespace
}  // namespace terracut::packet
