// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "thrift_compact.hpp"

#include <utility>

namespace terracut::cli {

void ThriftCompact::text(int field, std::string_view value) {
  begin_field(field, 8);
  length_and(value);
}

void ThriftCompact::begin_struct(int field) {
  begin_field(field, 12);
  last_field_.push_back(0);
}

void ThriftCompact::end_struct() {
  bytes_ += '\0';
  last_field_.pop_back();
}

void ThriftCompact::list(int field, Element element, std::size_t size) {
  constexpr std::size_t kLong = 15;
  begin_field(field, 9);
  const auto type = static_cast<unsigned>(element);
  bytes_ += static_cast<char>((size < kLong ? size : kLong) << 4 | type);
  if (size >= kLong) varint(size);
}

std::string ThriftCompact::take() {
  end_struct();
  return std::move(bytes_);
}

void ThriftCompact::begin_field(int field, unsigned type) {
  const int step =
      field - std::exchange(last_field_.back(), field);  // 1 to 15 in Parquet's structs
  bytes_ += static_cast<char>(static_cast<unsigned>(step) << 4 | type);
}

void ThriftCompact::whole_number(int field, unsigned type, std::int64_t value) {
  begin_field(field, type);
  zigzag(value);
}

void ThriftCompact::varint(std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes_ += static_cast<char>((value & 0x7F) | 0x80);
  bytes_ += static_cast<char>(value);
}

void ThriftCompact::zigzag(std::int64_t value) {
  varint(static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
}

void ThriftCompact::length_and(std::string_view text) {
  varint(text.size());
  bytes_ += text;
}

}  // namespace terracut::cli
