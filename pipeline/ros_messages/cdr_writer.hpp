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

namespace terracut::ros_messages {

/// Writes a message in ROS 2's serialisation: OMG CDR, little-endian, version 1, with its
/// encapsulation header. Numbers are aligned to their size, counted from the end of that header.
class CdrWriter {
 public:
  static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");
  static constexpr std::size_t kEncapsulationBytes = 4;

  /// Begins a message in `bytes`, replacing the content. `bytes` must outlive this object.
  explicit CdrWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {
    bytes_.assign({std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}});
  }

  template <class Number>
    requires std::is_arithmetic_v<Number>
  void add(Number number) {
    align(sizeof(Number));
    append(std::as_bytes(std::span(&number, 1)));
  }
  void add(bool flag) { add(static_cast<std::uint8_t>(flag)); }
  /// Adds a text with a terminating zero; the length written before the text includes the zero.
  void add(std::string_view text) {
    add(static_cast<std::uint32_t>(text.size() + 1));
    append(std::as_bytes(std::span(text)));
    bytes_.push_back(std::byte{0});
  }
  /// Adds the number of elements of a sequence. The caller then adds the elements.
  void add_length(std::size_t elements) { add(static_cast<std::uint32_t>(elements)); }
  /// Adds a sequence<uint8> and returns its bytes for the caller to fill until the next call.
  [[nodiscard]] std::span<std::byte> add_byte_sequence(std::size_t count) {
    add_length(count);
    bytes_.resize(bytes_.size() + count);
    return std::span(bytes_).last(count);
  }

 private:
  void align(std::size_t size) {
    const std::size_t beyond = (bytes_.size() - kEncapsulationBytes) % size;
    if (beyond != 0) bytes_.resize(bytes_.size() + size - beyond);
  }
  void append(std::span<const std::byte> more) {
    bytes_.insert(bytes_.end(), more.begin(), more.end());
  }

  std::vector<std::byte>& bytes_;
};

}  // namespace terracut::ros_messages
