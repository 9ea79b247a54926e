// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/timestamp.hpp"

#include <gtest/gtest.h>

#include <random>

namespace terracut::ruby128 {
namespace {

using Bytes = std::array<std::uint8_t, 10>;

// 2026-11-21 12:34:56.789123456 UTC, by `date -u -d ... +%s`.
constexpr std::int64_t kMoment_ns = 1'795'264'496'789'123'456;

TEST(RubyTimestamp, ReadsTheCalendar) {
  const Bytes bytes{26, 11, 21, 12, 34, 56, 789 >> 8, 789 & 0xFF, 0, 123};
  EXPECT_EQ(read_ruby_timestamp(bytes, RubyTimestamp::kCalendar), kMoment_ns - 456);
}

TEST(RubyTimestamp, ReadsALeapDay) {
  const Bytes bytes{24, 2, 29, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(read_ruby_timestamp(bytes, RubyTimestamp::kCalendar), 1'709'164'800'000'000'000);
}

TEST(RubyTimestamp, ReadsSecondsWithMicroseconds) {
  // 1795264496 = 0x6B018FF0, 789123 = 0x000C0A83
  const Bytes bytes{0, 0, 0x6B, 0x01, 0x8F, 0xF0, 0x00, 0x0C, 0x0A, 0x83};
  EXPECT_EQ(read_ruby_timestamp(bytes, RubyTimestamp::kUtcMicroseconds), kMoment_ns - 456);
}

TEST(RubyTimestamp, ReadsSecondsWithNanoseconds) {
  // 789123456 = 0x2F091180
  const Bytes bytes{0, 0, 0x6B, 0x01, 0x8F, 0xF0, 0x2F, 0x09, 0x11, 0x80};
  EXPECT_EQ(read_ruby_timestamp(bytes, RubyTimestamp::kUtcNanoseconds), kMoment_ns);
}

TEST(RubyTimestamp, WritesWhatItReads) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> moment(946'684'800'000'000'000,  // 2000-01-01
                                                     8'000'000'000'000'000'000);
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t time_ns = moment(random), time_us = time_ns / 1000 * 1000;
    for (const auto encoding : {RubyTimestamp::kCalendar, RubyTimestamp::kUtcMicroseconds}) {
      EXPECT_EQ(read_ruby_timestamp(write_ruby_timestamp(time_ns, encoding), encoding), time_us);
    }
    const auto ns = RubyTimestamp::kUtcNanoseconds;
    EXPECT_EQ(read_ruby_timestamp(write_ruby_timestamp(time_ns, ns), ns), time_ns);
  }
}

TEST(RubyTimestamp, TakesAnyBytesWithoutHarm) {
  std::mt19937 random(1);
  for (int i = 0; i < 100'000; ++i) {
    Bytes bytes;
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    for (const auto encoding : {RubyTimestamp::kCalendar, RubyTimestamp::kUtcMicroseconds,
                                RubyTimestamp::kUtcNanoseconds}) {
      EXPECT_GE(read_ruby_timestamp(bytes, encoding), 0);
    }
  }
}

/// Packets of one stream, one packet period apart.
RubyTimestampDetector watch(RubyTimestamp encoding, std::int64_t start_ns, int packets) {
  RubyTimestampDetector detector;
  for (int i = 0; i < packets; ++i) {
    detector.add(write_ruby_timestamp(start_ns + i * std::int64_t{166'650}, encoding));
  }
  return detector;
}

TEST(RubyTimestampDetector, KnowsTheCalendarFromTheFirstPacket) {
  const auto detector = watch(RubyTimestamp::kCalendar, kMoment_ns, 1);
  EXPECT_TRUE(detector.complete());
  EXPECT_EQ(detector.encoding(), RubyTimestamp::kCalendar);
}

TEST(RubyTimestampDetector, KnowsTheCalendarOfAUnitThatStandsInTheYear2000) {
  // A unit without time begins there: its first byte, the year, is 0 as that of UTC seconds is.
  for (const std::int64_t start_ns : {946'684'800'000'000'000,     // 2000-01-01
                                      978'307'199'999'900'000}) {  // 2000-12-31 23:59:59.9999
    RubyTimestampDetector detector = watch(RubyTimestamp::kCalendar, start_ns, 1);
    EXPECT_TRUE(detector.complete());
    EXPECT_EQ(detector.encoding(), RubyTimestamp::kCalendar);
  }
}

TEST(RubyTimestampDetector, TakesUtcSecondsOfTheNextEightyYearsForNoCalendar) {
  const auto detector = watch(RubyTimestamp::kUtcMicroseconds,
                              std::int64_t{0xFFFF'FFFF} * 1'000'000'000, 2);  // in 2106
  EXPECT_TRUE(detector.complete());
  EXPECT_EQ(detector.encoding(), RubyTimestamp::kUtcMicroseconds);
}

TEST(RubyTimestampDetector, LearnsNothingFromAPacketThatIsRepeated) {
  RubyTimestampDetector detector;
  const auto stamp =
      write_ruby_timestamp(1'795'264'496'000'100'000, RubyTimestamp::kUtcNanoseconds);
  detector.add(stamp);
  detector.add(stamp);
  EXPECT_FALSE(detector.complete()) << "a step of 0 is below every packet's period";
}

TEST(RubyTimestampDetector, KnowsNanosecondsByAValueThatMicrosecondsCannotHave) {
  const auto detector = watch(RubyTimestamp::kUtcNanoseconds, kMoment_ns, 1);
  EXPECT_TRUE(detector.complete());
  EXPECT_EQ(detector.encoding(), RubyTimestamp::kUtcNanoseconds);
}

TEST(RubyTimestampDetector, TakesMicrosecondsForGrantedButSaysItIsNotProven) {
  const auto detector = watch(RubyTimestamp::kUtcMicroseconds, kMoment_ns, 1);
  EXPECT_FALSE(detector.complete());
  EXPECT_EQ(detector.encoding(), RubyTimestamp::kUtcMicroseconds);
}

TEST(RubyTimestampDetector, TellsTheUnitByThePacketPeriod) {
  const auto us = watch(RubyTimestamp::kUtcMicroseconds, kMoment_ns, 2);
  EXPECT_TRUE(us.complete());
  EXPECT_EQ(us.encoding(), RubyTimestamp::kUtcMicroseconds);
  // In the first millisecond of a second nanoseconds look like microseconds.
  const auto ns = watch(RubyTimestamp::kUtcNanoseconds, 1'795'264'496'000'100'000, 2);
  EXPECT_FALSE(ns.complete());
  EXPECT_EQ(ns.encoding(), RubyTimestamp::kUtcNanoseconds);
}

TEST(RubyTimestampDetector, IsNotMisledByAGap) {
  for (const int lost : {1, 18, 19, 100, 299, 400, 1000}) {
    RubyTimestampDetector detector;
    const auto us = RubyTimestamp::kUtcMicroseconds;
    const std::int64_t begin_ns = 1'795'264'496'100'000'000;
    for (const int n : {0, lost + 1, lost + 2}) {
      detector.add(write_ruby_timestamp(begin_ns + n * std::int64_t{166'650}, us));
    }
    EXPECT_TRUE(detector.complete()) << lost;
    EXPECT_EQ(detector.encoding(), us) << lost;
  }
}

TEST(RubyTimestampDetector, WaitsWhereASecondBegins) {
  RubyTimestampDetector detector;
  const auto us = RubyTimestamp::kUtcMicroseconds;
  detector.add(write_ruby_timestamp(1'795'264'496'999'990'000, us));
  detector.add(write_ruby_timestamp(1'795'264'497'000'156'000, us));
  EXPECT_FALSE(detector.complete());
  detector.add(write_ruby_timestamp(1'795'264'497'000'322'000, us));
  EXPECT_TRUE(detector.complete());
  EXPECT_EQ(detector.encoding(), us);
}

}  // namespace
}  // namespace terracut::ruby128
