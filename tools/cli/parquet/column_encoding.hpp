// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace terracut::cli {

// Parquet's encodings of a column's values (parquet-format, Encodings.md), little-endian.

/// PLAIN: as they lie in memory.
template <class Value>
[[nodiscard]] std::string plain(std::span<const Value> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

/// BYTE_STREAM_SPLIT: all first bytes, then all second ones and so on. Bytes of one weight are more
/// alike than those of one number, so that they compress better.
[[nodiscard]] std::string byte_stream_split(std::span<const float> values);

/// DELTA_BINARY_PACKED: differences from one value to the next, bit-packed in blocks of 128. For
/// what rises steadily.
[[nodiscard]] std::string delta_binary_packed(std::span<const std::int32_t> values);

}  // namespace terracut::cli
