// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

namespace terracut::can {

/// What a message on the bus goes by. The same number means another message in the other format.
struct CanId {
  static constexpr std::uint32_t kStandardMost = 0x7FF;       ///< 11 bits
  static constexpr std::uint32_t kExtendedMost = 0x1FFFFFFF;  ///< 29 bits

  std::uint32_t number = 0;
  bool extended = false;  ///< 29 bits instead of 11.

  [[nodiscard]] constexpr bool valid() const noexcept {
    return number <= (extended ? kExtendedMost : kStandardMost);
  }
  friend constexpr auto operator<=>(const CanId&, const CanId&) = default;
};

/// One frame of a CAN bus, classic or FD. A plain value.
struct CanFrame {
  static constexpr std::size_t kMostBytes = 64;        ///< Of an FD frame.
  static constexpr std::size_t kMostClassicBytes = 8;  ///< Of any other.

  std::int64_t stamp_ns = 0;  ///< When it was received, nanoseconds since 1970 (UTC).
  CanId id;                   ///< Of an error frame: the kind of error, extended false.
  bool fd = false;
  bool bit_rate_switch = false;  ///< FD: the data were sent faster than the rest.
  bool sender_passive = false;   ///< FD: its sender had seen too many errors (ESI).
  bool remote = false;           ///< Asks for data; there are none in it.
  bool error = false;            ///< Made by the local controller; never was on the bus.
  std::uint8_t length = 0;       ///< Bytes of data; of a remote frame, how many it asks for.
  std::array<std::uint8_t, kMostBytes> data{};  ///< What is beyond `length` is 0.

  /// A message's data: the only kind of frame that signals are read from.
  [[nodiscard]] constexpr bool is_data() const noexcept { return !remote && !error; }
  [[nodiscard]] constexpr std::span<const std::uint8_t> payload() const noexcept {
    return std::span(data).first(remote ? 0 : length);
  }
  friend constexpr bool operator==(const CanFrame&, const CanFrame&) = default;
};

/// The lengths an FD frame can have: all up to 8, then 12, 16, 20, 24, 32, 48 and 64 bytes.
[[nodiscard]] constexpr bool is_fd_length(std::size_t bytes) noexcept {
  return bytes <= 8 || bytes == 12 || bytes == 16 || bytes == 20 || bytes == 24 || bytes == 32 ||
         bytes == 48 || bytes == 64;
}

}  // namespace terracut::can
