// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/transpose.hpp"

#include <cstring>

namespace terracut::frame {
namespace {

using EightBytes = std::uint8_t __attribute__((vector_size(8)));
using EightWords = std::uint16_t __attribute__((vector_size(16)));

/// Eight rows of eight, `stride` values apart, to eight columns. Three times the rows of one half
/// are put between those of the other.
template <class Row, class Value>
void transpose_eight(const Value* from, std::size_t from_stride, Value* to,
                     std::size_t to_stride) noexcept {
  Row row[8], next[8];
  for (std::size_t i = 0; i < 8; ++i) std::memcpy(&row[i], from + i * from_stride, sizeof(Row));
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = 0; i < 4; ++i) {
      next[2 * i] = __builtin_shufflevector(row[i], row[i + 4], 0, 8, 1, 9, 2, 10, 3, 11);
      next[2 * i + 1] = __builtin_shufflevector(row[i], row[i + 4], 4, 12, 5, 13, 6, 14, 7, 15);
    }
    std::memcpy(row, next, sizeof(row));
  }
  for (std::size_t i = 0; i < 8; ++i) std::memcpy(to + i * to_stride, &row[i], sizeof(Row));
}

template <class Row, class Value>
void transpose_all(const Value* from, std::size_t rows, std::size_t columns, Value* to) noexcept {
  for (std::size_t row = 0; row < rows; row += 8) {
    for (std::size_t column = 0; column < columns; column += 8) {
      transpose_eight<Row>(from + row * columns + column, columns, to + column * rows + row, rows);
    }
  }
}

}  // namespace

void transpose(const std::uint16_t* from, std::size_t rows, std::size_t columns,
               std::uint16_t* to) noexcept {
  transpose_all<EightWords>(from, rows, columns, to);
}
void transpose(const std::uint8_t* from, std::size_t rows, std::size_t columns,
               std::uint8_t* to) noexcept {
  transpose_all<EightBytes>(from, rows, columns, to);
}

}  // namespace terracut::frame
