// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/send/device_stamp_shift.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/ruby128/timestamp.hpp"

namespace terracut::test {
namespace {

using ruby128::RubyTimestamp;
using send::DeviceStampShift;

std::vector<std::uint8_t> hdl64e_packet(std::uint32_t stamp_us) {
  hdl64e::wire::Packet packet = hdl64e::blank_packet();
  for (std::size_t block = 0; block < packet.blocks.size(); ++block) {
    packet.blocks[block].azimuth_cdeg = static_cast<std::uint16_t>(100 + 17 * (block / 2));
  }
  packet.stamp_us = stamp_us;
  packet.status_type = 12;
  packet.status_value = 34;
  const auto payload = hdl64e::payload_of(packet);
  return {payload.begin(), payload.end()};
}

std::uint32_t shifted_us(std::uint32_t stamp_us, std::int64_t shift_ns) {
  auto packet = hdl64e_packet(stamp_us);
  EXPECT_TRUE(DeviceStampShift()(packet, shift_ns));
  return hdl64e::packet_in(packet)->stamp_us.value();
}

TEST(DeviceStampShift, MovesTheClockOfAnHdl64e) {
  EXPECT_EQ(shifted_us(5'000'000, 2'000'000'000), 7'000'000U);
  EXPECT_EQ(shifted_us(5'000'000, -2'000'000'000), 3'000'000U);
  EXPECT_EQ(shifted_us(10, 1'499), 11U);
  EXPECT_EQ(shifted_us(10, 1'500), 12U);
  EXPECT_EQ(shifted_us(10, -1'500), 8U);
}

TEST(DeviceStampShift, WrapsAtTheHour) {
  EXPECT_EQ(shifted_us(hdl64e::kDeviceHour_us - 1, 1'000), 0U);
  EXPECT_EQ(shifted_us(0, -1'000), hdl64e::kDeviceHour_us - 1);
  EXPECT_EQ(shifted_us(42, std::int64_t{25} * 3600 * 1'000'000'000), 42U);
}

TEST(DeviceStampShift, ChangesNothingElse) {
  auto shifted = hdl64e_packet(5'000'000);
  ASSERT_TRUE(DeviceStampShift()(shifted, 1'000'000));
  EXPECT_EQ(shifted, hdl64e_packet(5'001'000));
}

std::vector<std::uint8_t> ruby_packet(std::int64_t stamp_ns, RubyTimestamp encoding) {
  std::vector<std::uint8_t> packet(ruby128::kRubyPacketBytes);
  std::copy(ruby128::kRubyMagic.begin(), ruby128::kRubyMagic.end(), packet.begin());
  const auto stamp = ruby128::write_ruby_timestamp(stamp_ns, encoding);
  std::copy(stamp.begin(), stamp.end(), packet.begin() + 10);
  for (const std::size_t block : {80U, 468U, 856U}) packet[block] = ruby128::kRubyBlockId;
  return packet;
}

TEST(DeviceStampShift, MovesTheClockOfARuby128InEachEncoding) {
  constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000, kPeriod_ns = 166'000;
  for (const auto encoding : {RubyTimestamp::kCalendar, RubyTimestamp::kUtcMicroseconds,
                              RubyTimestamp::kUtcNanoseconds}) {
    DeviceStampShift shift;
    for (std::int64_t i = 0; i < 10; ++i) {
      const std::int64_t stamp_ns = kStart_ns + i * kPeriod_ns;
      const std::int64_t shift_ns = i < 5 ? 0 : -2'000'000'000;
      auto packet = ruby_packet(stamp_ns, encoding);
      ASSERT_TRUE(shift(packet, shift_ns));
      EXPECT_EQ(packet, ruby_packet(stamp_ns + shift_ns, encoding))
          << to_string(encoding) << ", packet " << i;
    }
  }
}

TEST(DeviceStampShift, LeavesWhatIsNoDataPacketAlone) {
  auto truncated = hdl64e_packet(5'000'000);
  truncated.resize(603);
  std::vector<std::uint8_t> position(512, 7), empty;
  for (auto* payload : {&truncated, &position, &empty}) {
    const auto before = *payload;
    EXPECT_FALSE(DeviceStampShift()(*payload, 1'000'000));
    EXPECT_EQ(*payload, before);
  }
}

}  // namespace
}  // namespace terracut::test
