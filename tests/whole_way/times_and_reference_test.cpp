// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "firmware_io/hdl64e/firing_times.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/ruby128/firing_azimuth.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "tests/support/reference/hdl64e_reference.hpp"
#include "tests/support/reference/rotating_head.hpp"
#include "tests/support/reference/ruby128_reference.hpp"

namespace terracut::reference {
namespace {

using ruby128::RubyTimestamp;

TEST(TimesAndReference, LasersOfTheHdl64eFireWhenTheReferenceSays) {
  for (const bool dual_return : {false, true}) {
    const auto payloads =
        hdl64e_payloads({.dual_return = dual_return, .packets = 1, .share_of_returns = 1});
    const Packet packet = Hdl64eReference({}).decode(payloads[0].bytes);
    ASSERT_EQ(packet.returns.size(), 6U * 64U);
    const auto& times = dual_return ? hdl64e::kFiringTimesDual : hdl64e::kFiringTimesSingle48;
    for (const Return& beam : packet.returns) {
      const int firing = beam.column * times.columns_per_packet / 6;
      const auto after_first_ns = times.column_ns * firing + times.laser_ns(beam.laser % 32);
      ASSERT_NEAR(after_first_ns, beam.fired_us * 1e3, 1e-6) << beam.column << ", " << beam.laser;
    }
  }
}

TEST(TimesAndReference, ChannelsOfTheRuby128FireWhenTheReferenceSays) {
  const auto payloads = ruby128_payloads({.packets = 1, .share_of_returns = 1});
  const Packet packet = Ruby128Reference({}).decode(payloads[0].bytes);
  ASSERT_EQ(packet.returns.size(), 3U * 128U);
  for (const Return& beam : packet.returns) {
    const auto after_first_ns =
        ruby128::kRubyBlock_ns * beam.column + ruby128::ruby_channel_ns(beam.laser);
    ASSERT_NEAR(after_first_ns, beam.fired_us * 1e3, 1e-6) << beam.column << ", " << beam.laser;
  }
}

class RubyClocks : public testing::Test {
 protected:
  std::int64_t read(RubyTimestamp encoding) const {
    return ruby128::read_ruby_timestamp(std::span(bytes_).subspan<10, 10>(), encoding);
  }
  std::uint8_t below(int count) {
    return static_cast<std::uint8_t>(std::uniform_int_distribution<int>(0, count - 1)(random_));
  }

  std::mt19937 random_{1};
  std::vector<std::uint8_t> bytes_ = std::vector<std::uint8_t>(1248);
};

TEST_F(RubyClocks, GiveTheReferencesTimeInEveryEncoding) {
  int dates = 0, microseconds = 0, nanoseconds = 0;
  for (int n = 0; n < 100'000; ++n) {
    // Half of them dates, half of them seconds up to the year 2242.
    const bool date = n % 2 == 0;
    for (std::size_t i = 10; i < 20; ++i) bytes_[i] = below(256);
    if (date) {
      bytes_[11] = static_cast<std::uint8_t>(1 + below(12));
      bytes_[12] = static_cast<std::uint8_t>(1 + below(31));
      bytes_[13] = below(24);
      bytes_[14] = below(60);
      bytes_[15] = below(60);
      bytes_[16] = bytes_[18] = below(4);
    } else {
      bytes_[10] = 0;
      bytes_[11] = below(2);
      bytes_[16] = below(64);
      if (bytes_[16] < 32) bytes_[16] = 0, bytes_[17] = below(16);
    }
    const auto calendar_ns = ruby128_calendar_ns(bytes_);
    const auto microseconds_ns = ruby128_microseconds_ns(bytes_);
    const auto nanoseconds_ns = ruby128_nanoseconds_ns(bytes_);
    if (date && calendar_ns) {
      ASSERT_EQ(read(RubyTimestamp::kCalendar), *calendar_ns);
      ++dates;
    }
    if (!date && microseconds_ns) {
      ASSERT_EQ(read(RubyTimestamp::kUtcMicroseconds), *microseconds_ns);
      ++microseconds;
    }
    if (!date && nanoseconds_ns) {
      ASSERT_EQ(read(RubyTimestamp::kUtcNanoseconds), *nanoseconds_ns);
      ++nanoseconds;
    }
  }
  EXPECT_GT(std::min({dates, microseconds, nanoseconds}), 10'000);
}

TEST_F(RubyClocks, KnownTimesAreWhatTheyAre) {
  // 2024-02-29 23:59:58.123456 UTC
  const std::vector<std::uint8_t> calendar{24, 2, 29, 23, 59, 58, 0, 123, 0x01, 0xC8};
  std::copy(calendar.begin(), calendar.end(), bytes_.begin() + 10);
  EXPECT_EQ(ruby128_calendar_ns(bytes_), 1'709'251'198'123'456'000);
  const std::vector<std::uint8_t> seconds{0, 0, 0x65, 0xE1, 0x1A, 0x7E, 0, 1, 0xE2, 0x40};
  std::copy(seconds.begin(), seconds.end(), bytes_.begin() + 10);
  EXPECT_EQ(ruby128_microseconds_ns(bytes_), 1'709'251'198'123'456'000);
  EXPECT_EQ(ruby128_nanoseconds_ns(bytes_), 1'709'251'198'000'123'456);
}

TEST_F(RubyClocks, TemperatureIsTheReferences) {
  for (int high = 0; high < 256; ++high) {
    for (int low = 0; low < 256; ++low) {
      bytes_[8] = static_cast<std::uint8_t>(high);
      bytes_[9] = static_cast<std::uint8_t>(low);
      const auto* packet = ruby128::packet_in(bytes_);
      ASSERT_NE(packet, nullptr);
      ASSERT_EQ(ruby128::ruby_temperature_deg_c(packet->temperature.value()),
                ruby128_temperature_c(bytes_));
    }
  }
}

}  // namespace
}  // namespace terracut::reference
