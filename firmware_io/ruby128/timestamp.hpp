// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ruby128 {

/// How the ten stamp bytes of a RoboSense packet are encoded; three encodings are in use
/// (docs/reference/sensors.md).
enum class RubyTimestamp : std::uint8_t {
  kCalendar,         ///< Year since 2000, month, day, hour, minute, second, ms and us.
  kUtcMicroseconds,  ///< Six bytes of seconds since 1970, four of microseconds.
  kUtcNanoseconds,   ///< Six bytes of seconds since 1970, four of nanoseconds.
};

/// Returns "calendar", "UTC seconds and microseconds" or "UTC seconds and nanoseconds".
[[nodiscard]] std::string_view to_string(RubyTimestamp encoding) noexcept;

/// Returns nanoseconds since 1970 on the device's clock. Calendar fields out of range carry over:
/// month 13 is the next year's January. Seconds wrap at 2^33 (the year 2242).
[[nodiscard]] std::int64_t read_ruby_timestamp(
    std::span<const std::uint8_t, 10> bytes, RubyTimestamp encoding) noexcept TERRACUT_NONBLOCKING;

/// Encodes a time, rounded down to the encoding's unit; years 2000..2255 for the calendar.
[[nodiscard]] std::array<std::uint8_t, 10> write_ruby_timestamp(std::int64_t time_ns,
                                                                RubyTimestamp encoding) noexcept;

/// Finds out from the packets of one stream which encoding its sensor uses. complete() tells
/// whether the answer is proven or only the likelier one.
///
/// A year or a month in the first two bytes means a calendar: UTC seconds leave both bytes 0 until
/// 2106, and a calendar has no month 0. A sub-second value above 999,999 means nanoseconds. A step
/// between two packets that would be too short for a packet period in nanoseconds means
/// microseconds. Until one of these is seen the likelier unit is assumed: microseconds, or
/// nanoseconds after a long step. Real-time safe; one thread.
class RubyTimestampDetector {
 public:
  /// Returns the encoding by which to read this packet's stamp.
  RubyTimestamp add(std::span<const std::uint8_t, 10> stamp) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] RubyTimestamp encoding() const noexcept { return encoding_; }
  [[nodiscard]] bool complete() const noexcept { return complete_; }

 private:
  RubyTimestamp encoding_ = RubyTimestamp::kUtcMicroseconds;
  bool complete_ = false;
  bool has_last_ = false;
  std::uint32_t last_sub_second_ = 0;
};

struct RubyClockConfig {
  std::optional<RubyTimestamp> timestamp;  ///< The stamps' encoding; empty: found out.
};

/// Reads the stamps of one stream. Real-time safe; one thread.
class RubyClock {
 public:
  explicit RubyClock(std::optional<RubyTimestamp> given) noexcept : given_(given) {}

  /// Fills in the stamp, and that the clock starts anew if its encoding turned out to be another:
  /// in about one start in a thousand the first packet's stamp is read in the wrong unit of UTC,
  /// and a later packet corrects that. Returns nanoseconds since 1970.
  std::int64_t read(std::span<const std::uint8_t, 10> stamp,
                    packet::PacketAzimuths& azimuths) noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] const RubyTimestampDetector& detector() const noexcept { return detector_; }

 private:
  std::optional<RubyTimestamp> given_, last_;
  RubyTimestampDetector detector_;
};

}  // namespace terracut::ruby128
