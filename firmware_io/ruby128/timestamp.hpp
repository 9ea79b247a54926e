// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "rt/threads/nonblocking.hpp"

namespace terracut::ruby128 {

/// What the ten stamp bytes of a RoboSense packet mean: three encodings are in the field
/// (docs/reference/sensors.md).
enum class RubyTimestamp : std::uint8_t {
  kCalendar,         ///< Year since 2000, month, day, hour, minute, second, ms and us.
  kUtcMicroseconds,  ///< Six bytes of seconds since 1970, four of microseconds.
  kUtcNanoseconds,   ///< Six bytes of seconds since 1970, four of nanoseconds.
};

/// "calendar", "UTC seconds and microseconds", "UTC seconds and nanoseconds".
[[nodiscard]] std::string_view to_string(RubyTimestamp encoding) noexcept;

/// Nanoseconds since 1970 by the device's clock. Calendar fields out of range are taken as they
/// are: month 13 is the next year's January. Seconds wrap at 2^33 (the year 2242).
[[nodiscard]] std::int64_t read_ruby_timestamp(
    std::span<const std::uint8_t, 10> bytes, RubyTimestamp encoding) noexcept TERRACUT_NONBLOCKING;

/// The inverse, rounded down to the encoding's unit; years 2000..2255 for the calendar.
[[nodiscard]] std::array<std::uint8_t, 10> write_ruby_timestamp(std::int64_t time_ns,
                                                                RubyTimestamp encoding) noexcept;

/// Finds out from the packets of one stream which encoding its sensor uses. Never guesses silently:
/// complete() tells whether the answer is proven or still the most common one.
///
/// A year or a month in the first two bytes is a calendar's: UTC seconds leave both 0 until 2106,
/// and a calendar has no month 0. A sub-second value above 999,999 can only be nanoseconds; a step
/// between two packets too short for a nanosecond's packet period, microseconds. Until one of these
/// is seen the likelier unit is taken: microseconds, or nanoseconds after a long step. Real-time
/// safe; one thread.
class RubyTimestampDetector {
 public:
  /// The encoding by which to read this packet's stamp.
  RubyTimestamp add(std::span<const std::uint8_t, 10> stamp) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] RubyTimestamp encoding() const noexcept { return encoding_; }
  [[nodiscard]] bool complete() const noexcept { return complete_; }

 private:
  RubyTimestamp encoding_ = RubyTimestamp::kUtcMicroseconds;
  bool complete_ = false;
  bool has_last_ = false;
  std::uint32_t last_sub_second_ = 0;
};

}  // namespace terracut::ruby128
