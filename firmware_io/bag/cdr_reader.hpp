// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace terracut::bag {

/// Reads a message in ROS 2's serialisation: OMG CDR, version 1, of either byte order, as
/// ros_messages::CdrWriter writes it. Never reads outside the message: after a fault, failed() is
/// true and all further values are zero or empty. Spans and texts point into the message.
class CdrReader {
 public:
  static constexpr std::size_t kEncapsulationBytes = 4;

  explicit CdrReader(std::span<const std::byte> message) noexcept {
    static_assert(std::endian::native == std::endian::little, "big-endian values are turned round");
    constexpr std::byte kLittle{1};
    failed_ =
        message.size() < kEncapsulationBytes || message[0] != std::byte{0} || message[1] > kLittle;
    if (failed_) return;
    is_swapped_ = message[1] != kLittle;
    rest_ = body_ = message.subspan(kEncapsulationBytes);
  }

  [[nodiscard]] bool failed() const noexcept { return failed_; }
  /// True if the numbers of the message are big-endian.
  [[nodiscard]] bool is_big_endian() const noexcept { return is_swapped_; }
  /// Ends reading at a value that cannot be.
  void fail() noexcept { failed_ = true; }

  template <class Number>
    requires std::is_arithmetic_v<Number>
  [[nodiscard]] Number number() noexcept {
    (void)bytes((sizeof(Number) - (body_.size() - rest_.size()) % sizeof(Number)) % sizeof(Number));
    const std::span<const std::byte> from = bytes(sizeof(Number));
    if (failed_) return {};
    std::array<std::byte, sizeof(Number)> value;
    std::ranges::copy(from, value.begin());
    if (is_swapped_) std::ranges::reverse(value);
    return std::bit_cast<Number>(value);
  }
  /// Reads a text, whose length counts its terminating zero.
  [[nodiscard]] std::string_view text() noexcept {
    const std::span<const std::byte> from = bytes(number<std::uint32_t>());
    if (from.empty()) return {};
    return {reinterpret_cast<const char*>(from.data()), from.size() - 1};
  }
  /// Reads an array of bytes of a known length, uint8[count].
  [[nodiscard]] std::span<const std::byte> bytes(std::size_t count) noexcept {
    failed_ = failed_ || count > rest_.size();
    if (failed_) return {};
    const std::span<const std::byte> taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  /// Reads a sequence of bytes, sequence<uint8>.
  [[nodiscard]] std::span<const std::byte> byte_sequence() noexcept {
    return bytes(number<std::uint32_t>());
  }
  /// Reads the number of elements of a sequence whose elements take at least `least_bytes` each;
  /// a number that the rest of the message cannot hold is a fault.
  [[nodiscard]] std::size_t length(std::size_t least_bytes) noexcept {
    const std::size_t elements = number<std::uint32_t>();
    failed_ = failed_ || elements > rest_.size() / least_bytes;
    return failed_ ? 0 : elements;
  }
  /// Reads a builtin_interfaces/Time: nanoseconds since 1970.
  [[nodiscard]] std::int64_t time_ns() noexcept {
    const std::int64_t seconds = number<std::int32_t>();
    return seconds * 1'000'000'000 + number<std::uint32_t>();
  }

 private:
  std::span<const std::byte> body_, rest_;
  bool is_swapped_ = false, failed_ = false;
};

/// The content of a std_msgs/Header.
struct Header {
  std::int64_t stamp_ns = 0;
  std::string_view frame_id;

  [[nodiscard]] static Header read(CdrReader& from) noexcept {
    const std::int64_t stamp_ns = from.time_ns();
    return {stamp_ns, from.text()};
  }
};

}  // namespace terracut::bag
