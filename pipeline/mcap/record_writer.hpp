// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace terracut::mcap {

/// Writes records of an MCAP file (mcap.dev/spec), one after the other: opcode, length, then the
/// fields, little-endian without padding.
class RecordWriter {
 public:
  static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");

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

  /// Begins a record. The caller then adds fields and calls end().
  void begin(Opcode opcode) {
    add(static_cast<std::uint8_t>(opcode));
    begin_block<std::uint64_t>();
  }
  void end() { end_block<std::uint64_t>(); }

  template <class Number>
    requires std::is_integral_v<Number>
  void add(Number number) {
    append(std::as_bytes(std::span(&number, 1)));
  }
  void add(std::string_view text) {
    add(static_cast<std::uint32_t>(text.size()));
    append(std::as_bytes(std::span(text)));
  }
  void append(std::span<const std::byte> more) {
    bytes_.insert(bytes_.end(), more.begin(), more.end());
  }
  /// Begins an array or map. The caller then adds elements and calls end_elements().
  void begin_elements() { begin_block<std::uint32_t>(); }
  void end_elements() { end_block<std::uint32_t>(); }

  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }
  [[nodiscard]] std::size_t size() const noexcept { return bytes_.size(); }
  /// Removes all records and keeps the memory.
  void clear() noexcept { bytes_.clear(); }

 private:
  template <class Length>
  void begin_block() {
    blocks_.push_back(bytes_.size());
    add(Length{0});
  }
  template <class Length>
  void end_block() {
    const std::size_t at = blocks_.back();
    blocks_.pop_back();
    const auto length = static_cast<Length>(bytes_.size() - at - sizeof(Length));
    std::memcpy(bytes_.data() + at, &length, sizeof length);
  }

  std::vector<std::byte> bytes_;
  std::vector<std::size_t> blocks_;  ///< Offsets of the lengths of open blocks.
};

}  // namespace terracut::mcap
