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

#include "firmware_io/bag/mcap_records.hpp"

namespace terracut::mcap {

/// Writes records of an MCAP file (mcap.dev/spec), one after the other: opcode, length, then the
/// fields, little-endian without padding.
class RecordWriter {
 public:
  static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");

  /// Begins a record. The caller then adds fields and calls end().
  void begin(bag::Opcode opcode) {
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
