// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace terracut::cli {

/// Writes structs in Thrift's compact protocol, in which Parquet keeps what it says of a file
/// (thrift/doc/specs/thrift-compact-protocol.md). Fields of a struct come in rising order of their
/// numbers.
class ThriftCompact {
 public:
  ThriftCompact() : last_field_{0} {}

  void i32(int field, std::int32_t value) { whole_number(field, 5, value); }
  void i64(int field, std::int64_t value) { whole_number(field, 6, value); }
  void boolean(int field, bool value) { begin_field(field, value ? 1 : 2); }
  void text(int field, std::string_view value);

  void begin_struct(int field);
  void end_struct();

  enum class Element : unsigned char { kI32 = 5, kText = 8, kStruct = 12 };
  /// Followed by as many elements.
  void list(int field, Element element, std::size_t size);
  void element(std::int32_t value) { zigzag(value); }
  void element(std::string_view value) { length_and(value); }
  void begin_element() { last_field_.push_back(0); }
  void end_element() { end_struct(); }

  /// All of it, ended: the outermost struct.
  [[nodiscard]] std::string take();

 private:
  void begin_field(int field, unsigned type);
  void whole_number(int field, unsigned type, std::int64_t value);
  void varint(std::uint64_t value);
  void zigzag(std::int64_t value);
  void length_and(std::string_view text);

  std::string bytes_;
  std::vector<int> last_field_;  ///< Of each open struct.
};

}  // namespace terracut::cli
