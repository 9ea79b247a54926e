// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/timestamp.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace terracut::ruby128 {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::uint32_t kMostMicroseconds = 999'999;

std::uint32_t sub_second(std::span<const std::uint8_t, 10> bytes) noexcept {
  return std::uint32_t{bytes[6]} << 24 | std::uint32_t{bytes[7]} << 16 |
         std::uint32_t{bytes[8]} << 8 | std::uint32_t{bytes[9]};
}

/// Returns the lower 33 bits of the six bytes of seconds, so that the time in nanoseconds fits into
/// 63 bits.
std::int64_t seconds(std::span<const std::uint8_t, 10> bytes) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < 6; ++i) value = value << 8 | bytes[i];
  return static_cast<std::int64_t>(value & 0x1'FFFF'FFFF);
}

std::int64_t calendar_ns(std::span<const std::uint8_t, 10> bytes) noexcept {
  using namespace std::chrono;
  const int months = 12 * bytes[0] + bytes[1] - 1;  // an impossible month carries into the year
  const int years = months >= 0 ? months / 12 : -1;
  const auto month_of_year = static_cast<unsigned>(months - 12 * years) + 1;
  const sys_days first_of_month{year{2000 + years} / month{month_of_year} / 1};
  const microseconds time = first_of_month.time_since_epoch() + days{bytes[2] - 1} +
                            hours{bytes[3]} + minutes{bytes[4]} + std::chrono::seconds{bytes[5]} +
                            milliseconds{bytes[6] << 8 | bytes[7]} +
                            microseconds{bytes[8] << 8 | bytes[9]};
  // A later time would overflow: 64 bits of nanoseconds end in the year 2262.
  constexpr std::int64_t kLatest_us = std::numeric_limits<std::int64_t>::max() / 1000;
  return std::clamp<std::int64_t>(time.count(), 0, kLatest_us) * 1000;
}

}  // namespace

std::string_view to_string(RubyTimestamp encoding) noexcept {
  switch (encoding) {
    case RubyTimestamp::kCalendar:
      return "calendar";
    case RubyTimestamp::kUtcMicroseconds:
      return "UTC seconds and microseconds";
    case RubyTimestamp::kUtcNanoseconds:
      return "UTC seconds and nanoseconds";
  }
  return "unknown";
}

std::int64_t read_ruby_timestamp(std::span<const std::uint8_t, 10> bytes,
                                 RubyTimestamp encoding) noexcept {
  switch (encoding) {
    case RubyTimestamp::kCalendar:
      return calendar_ns(bytes);
    case RubyTimestamp::kUtcMicroseconds:
      return seconds(bytes) * kSecond_ns + std::int64_t{sub_second(bytes)} * 1000;
    case RubyTimestamp::kUtcNanoseconds:
      return seconds(bytes) * kSecond_ns + sub_second(bytes);
  }
  return 0;
}

std::array<std::uint8_t, 10> write_ruby_timestamp(std::int64_t time_ns,
                                                  RubyTimestamp encoding) noexcept {
  using namespace std::chrono;
  std::array<std::uint8_t, 10> bytes{};
  const auto byte = [](auto value) { return static_cast<std::uint8_t>(value); };
  if (encoding == RubyTimestamp::kCalendar) {
    const sys_time<nanoseconds> time{nanoseconds{time_ns}};
    const auto day = floor<days>(time);
    const year_month_day date{day};
    const hh_mm_ss clock{floor<microseconds>(time - day)};
    const auto us = static_cast<unsigned>(clock.subseconds().count());
    const unsigned whole_ms = us / 1000, rest_us = us % 1000;
    bytes = {byte(static_cast<int>(date.year()) - 2000),
             byte(static_cast<unsigned>(date.month())),
             byte(static_cast<unsigned>(date.day())),
             byte(clock.hours().count()),
             byte(clock.minutes().count()),
             byte(clock.seconds().count()),
             byte(whole_ms >> 8),
             byte(whole_ms),
             byte(rest_us >> 8),
             byte(rest_us)};
    return bytes;
  }
  const std::int64_t second = time_ns / kSecond_ns, rest_ns = time_ns % kSecond_ns;
  const std::int64_t fraction =
      encoding == RubyTimestamp::kUtcNanoseconds ? rest_ns : rest_ns / 1000;
  for (std::size_t i = 0; i < 6; ++i) bytes[i] = byte(second >> (8 * (5 - i)));
  for (std::size_t i = 0; i < 4; ++i) bytes[6 + i] = byte(fraction >> (8 * (3 - i)));
  return bytes;
}

RubyTimestamp RubyTimestampDetector::add(std::span<const std::uint8_t, 10> stamp) noexcept {
  if (complete_) return encoding_;
  const auto finalize = [this](RubyTimestamp encoding) {
    encoding_ = encoding;
    complete_ = true;
    return encoding;
  };
  if (stamp[0] != 0 || stamp[1] != 0) return finalize(RubyTimestamp::kCalendar);
  const std::uint32_t fraction = sub_second(stamp);
  if (fraction > kMostMicroseconds) return finalize(RubyTimestamp::kUtcNanoseconds);
  const std::uint32_t before = last_sub_second_;
  const bool has_before = has_last_;
  last_sub_second_ = fraction;
  has_last_ = true;
  if (!has_before || fraction <= before) return encoding_;
  // Packets are 55 to 167 microseconds apart, so the field grows by 55 to 167 if it counts
  // microseconds, or by a thousand times as much if it counts nanoseconds. A step below 50,000
  // proves microseconds. A longer step means nanoseconds, whose values soon exceed a million, or
  // microseconds with hundreds of packets missing.
  constexpr std::uint32_t kShortestPacket_ns = 50'000;
  if (fraction - before < kShortestPacket_ns) return finalize(RubyTimestamp::kUtcMicroseconds);
  return encoding_ = RubyTimestamp::kUtcNanoseconds;
}

std::int64_t RubyClock::read(std::span<const std::uint8_t, 10> stamp,
                             packet::PacketAzimuths& azimuths) noexcept {
  const RubyTimestamp detected = detector_.add(stamp);
  const RubyTimestamp encoding = given_.value_or(detected);
  azimuths.clock_restarts = encoding != last_.value_or(encoding);
  last_ = encoding;
  const std::int64_t stamp_ns = read_ruby_timestamp(stamp, encoding);
  azimuths.device_stamp_us = stamp_ns / 1000;
  return stamp_ns;
}

}  // namespace terracut::ruby128
