// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/transpose.hpp"

#include <cstring>

namespace terracut::frame {
namespace {

using EightWords = std::uint16_t __attribute__((vector_size(16)));
using SixteenBytes = std::uint8_t __attribute__((vector_size(16)));
using TwoRows = std::uint64_t __attribute__((vector_size(16)));

// first_in_turn() interleaves the first halves of two vectors, second_in_turn() the second halves.
EightWords first_in_turn(EightWords a, EightWords b) noexcept {
  return __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
}
EightWords second_in_turn(EightWords a, EightWords b) noexcept {
  return __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15);
}
SixteenBytes first_in_turn(SixteenBytes a, SixteenBytes b) noexcept {
  return __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
}
SixteenBytes second_in_turn(SixteenBytes a, SixteenBytes b) noexcept {
  return __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15,
                                 31);
}

/// Transposes eight rows of eight values, stored one after the other in `all`. Each round
/// interleaves the first half of the vectors with the second half, which rotates the bits of the
/// values' indices by one.
template <class Vector, std::size_t kVectors>
[[gnu::always_inline]] inline void turn(Vector (&all)[kVectors]) noexcept {
  for (int round = 0; round < 3; ++round) {
    Vector next[kVectors];
    for (std::size_t i = 0; i < kVectors / 2; ++i) {
      next[2 * i] = first_in_turn(all[i], all[i + kVectors / 2]);
      next[2 * i + 1] = second_in_turn(all[i], all[i + kVectors / 2]);
    }
    for (std::size_t i = 0; i < kVectors; ++i) all[i] = next[i];
  }
}

void transpose_eight(const std::uint16_t* from, std::size_t from_stride, std::uint16_t* to,
                     std::size_t to_stride) noexcept {
  EightWords all[8];
  for (std::size_t i = 0; i < 8; ++i) std::memcpy(&all[i], from + i * from_stride, sizeof(all[i]));
  turn(all);
  for (std::size_t i = 0; i < 8; ++i) std::memcpy(to + i * to_stride, &all[i], sizeof(all[i]));
}
void transpose_eight(const std::uint8_t* from, std::size_t from_stride, std::uint8_t* to,
                     std::size_t to_stride) noexcept {
  SixteenBytes all[4];
  for (std::size_t i = 0; i < 4; ++i) {
    std::uint64_t rows[2];
    std::memcpy(&rows[0], from + 2 * i * from_stride, sizeof(rows[0]));
    std::memcpy(&rows[1], from + (2 * i + 1) * from_stride, sizeof(rows[1]));
    all[i] = reinterpret_cast<SixteenBytes>(TwoRows{rows[0], rows[1]});
  }
  turn(all);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto rows = reinterpret_cast<TwoRows>(all[i]);
    const std::uint64_t first = rows[0], second = rows[1];
    std::memcpy(to + 2 * i * to_stride, &first, sizeof(first));
    std::memcpy(to + (2 * i + 1) * to_stride, &second, sizeof(second));
  }
}

template <class Value>
void transpose_all(const Value* from, std::size_t rows, std::size_t columns, Value* to) noexcept {
  for (std::size_t row = 0; row < rows; row += 8) {
    for (std::size_t column = 0; column < columns; column += 8) {
      transpose_eight(from + row * columns + column, columns, to + column * rows + row, rows);
    }
  }
}

}  // namespace

void transpose(const std::uint16_t* from, std::size_t rows, std::size_t columns,
               std::uint16_t* to) noexcept {
  transpose_all(from, rows, columns, to);
}
void transpose(const std::uint8_t* from, std::size_t rows, std::size_t columns,
               std::uint8_t* to) noexcept {
  transpose_all(from, rows, columns, to);
}

}  // namespace terracut::frame
