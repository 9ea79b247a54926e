// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/unknown_packets.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "firmware_io/packet/hdl64e_wire.hpp"

namespace terracut::sensor {
namespace {

using testing::HasSubstr;

TEST(GuessOfUnknown, FindsAPacketWithBytesAroundIt) {
  hdl64e::wire::Packet packet{};
  for (auto& block : packet.blocks) block.id = hdl64e::kUpperBlockId;
  packet.status_value = 0x22;
  std::vector<std::uint8_t> payload(8 + hdl64e::kHdl64ePacketBytes + 4);
  std::ranges::copy(hdl64e::payload_of(packet), payload.begin() + 8);
  EXPECT_THAT(guess_of_unknown({.payload = payload, .destination_port = 2368}),
              HasSubstr("packets of a Velodyne VLP-16 with 8 bytes before and 4 behind them"));
}

TEST(GuessOfUnknown, GoesByPortElseBySize) {
  const std::vector<std::uint8_t> ouster(24'896), hesai(1080), anything(777);
  EXPECT_THAT(guess_of_unknown({.payload = anything, .destination_port = 7502}),
              HasSubstr("Ouster"));
  EXPECT_THAT(guess_of_unknown({.payload = ouster, .destination_port = 1}), HasSubstr("Ouster"));
  EXPECT_THAT(guess_of_unknown({.payload = hesai, .destination_port = 2368}),
              HasSubstr("PandarXT-32"));
  EXPECT_EQ(guess_of_unknown({.payload = anything, .destination_port = 2368}), "");
}

}  // namespace
}  // namespace terracut::sensor
