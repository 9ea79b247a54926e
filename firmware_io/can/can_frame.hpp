// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

namespace terracut::can {

/// Identifies a message on the bus. The same number in the other id format is another message.
struct CanId {
  static constexpr std::uint32_t kStandardMost = 0x7FF;       ///< 11 bits
  static constexpr std::uint32_t kExtendedMost = 0x1FFFFFFF;  ///< 29 bits

  std::uint32_t number = 0;
  bool extended = false;  ///< True: an id of 29 bits; false: 11 bits.

  [[nodiscard]] constexpr bool valid() const noexcept {
    return number <= (extended ? kExtendedMost : kStandardMost);
  }
  friend constexpr auto operator<=>(const CanId&, const CanId&) = default;
};

/// One CAN frame, classic or FD.
struct CanFrame {
  static constexpr std::size_t kMostBytes = 64;        ///< most data bytes of an FD frame
  static constexpr std::size_t kMostClassicBytes = 8;  ///< most data bytes of a classic frame

  std::int64_t stamp_ns = 0;  ///< Time of reception, nanoseconds since 1970 (UTC).
  CanId id;  ///< In an error frame, the number is the kind of error, and extended is false.
  bool fd = false;
  bool bit_rate_switch = false;  ///< For FD: the data were sent at the higher bit rate.
  bool sender_passive = false;   ///< For FD: the sender had seen too many errors (ESI).
  bool remote = false;           ///< True for a request for data, which carries no data itself.
  bool error = false;            ///< True if the local controller made the frame to report a fault.
  std::uint8_t length = 0;  ///< Number of data bytes; in a remote frame, of the bytes asked for.
  std::array<std::uint8_t, kMostBytes> data{};  ///< Bytes from `length` on are 0.

  /// True for a message with data; signals are read only from these.
  [[nodiscard]] constexpr bool is_data() const noexcept { return !remote && !error; }
  [[nodiscard]] constexpr std::span<const std::uint8_t> payload() const noexcept {
    return std::span(data).first(remote ? 0 : length);
  }
  friend constexpr bool operator==(const CanFrame&, const CanFrame&) = default;
};

/// True for a length that an FD frame can have: up to 8, then 12, 16, 20, 24, 32, 48 or 64 bytes.
[[nodiscard]] constexpr bool is_fd_length(std::size_t bytes) noexcept {
  return bytes <= 8 || bytes == 12 || bytes == 16 || bytes == 20 || bytes == 24 || bytes == 32 ||
         bytes == 48 || bytes == 64;
}

}  // namespace terracut::can
