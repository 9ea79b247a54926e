// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace terracut::bag {

/// With these bytes an MCAP file begins and ends (mcap.dev/spec).
inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";
/// A record is its opcode, one byte, its length, eight bytes, and its content.
inline constexpr std::size_t kRecordHeaderBytes = 9;

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Reads the fields of a record: little-endian, without padding. Never reads outside the record:
/// after a fault, failed() is true and all further values are zero or empty.
class FieldReader {
 public:
  static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");

  explicit FieldReader(std::span<const std::byte> content) noexcept : rest_(content) {}

  template <class Number>
    requires std::is_integral_v<Number>
  [[nodiscard]] Number number() noexcept {
    Number value{};
    const std::span<const std::byte> from = bytes(sizeof value);
    if (!from.empty()) std::memcpy(&value, from.data(), sizeof value);
    return value;
  }
  [[nodiscard]] std::string_view text() noexcept {
    const std::span<const std::byte> from = bytes(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(from.data()), from.size()};
  }
  [[nodiscard]] std::span<const std::byte> bytes(std::size_t count) noexcept {
    failed_ = failed_ || count > rest_.size();
    if (failed_) return {};
    const std::span<const std::byte> taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  [[nodiscard]] std::span<const std::byte> rest() const noexcept { return rest_; }
  [[nodiscard]] bool failed() const noexcept { return failed_; }

 private:
  std::span<const std::byte> rest_;
  bool failed_ = false;
};

}  // namespace terracut::bag
