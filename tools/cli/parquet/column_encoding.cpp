// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "column_encoding.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace terracut::cli {
namespace {

constexpr std::size_t kBlock = 128, kMiniBlocks = 4, kMiniBlock = kBlock / kMiniBlocks;

void add_varint(std::string& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes += static_cast<char>((value & 0x7F) | 0x80);
  bytes += static_cast<char>(value);
}
void add_zigzag(std::string& bytes, std::int64_t value) {
  add_varint(bytes,
             static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
}

/// Lowest bit first, each number behind the one before.
void add_packed(std::string& bytes, std::span<const std::uint64_t> numbers, int width) {
  std::uint64_t waiting = 0;
  int bits = 0;
  for (const std::uint64_t number : numbers) {
    waiting |= number << bits;
    for (bits += width; bits >= 8; bits -= 8, waiting >>= 8) bytes += static_cast<char>(waiting);
  }
}

/// At most a block of differences; one that is not full is filled with zeros above the least.
void add_block(std::string& bytes, std::span<const std::int64_t> steps) {
  const std::int64_t least = std::ranges::min(steps);
  std::array<std::uint64_t, kBlock> above{};
  std::ranges::transform(steps, above.begin(), [&](std::int64_t step) {
    return static_cast<std::uint64_t>(step - least);
  });
  add_zigzag(bytes, least);
  std::array<int, kMiniBlocks> widths{};
  for (std::size_t i = 0; i < kMiniBlocks; ++i) {
    const auto mini = std::span(above).subspan(i * kMiniBlock, kMiniBlock);
    widths[i] = static_cast<int>(std::bit_width(std::ranges::max(mini)));
    bytes += static_cast<char>(widths[i]);
  }
  for (std::size_t i = 0; i < kMiniBlocks && i * kMiniBlock < steps.size(); ++i) {
    add_packed(bytes, std::span(above).subspan(i * kMiniBlock, kMiniBlock), widths[i]);
  }
}

}  // namespace

std::string byte_stream_split(std::span<const float> values) {
  std::string bytes(values.size_bytes(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(values[i]);
    for (std::size_t b = 0; b < sizeof(bits); ++b) {
      bytes[b * values.size() + i] = static_cast<char>(bits >> (8 * b));
    }
  }
  return bytes;
}

std::string delta_binary_packed(std::span<const std::int32_t> values) {
  std::string bytes;
  add_varint(bytes, kBlock);
  add_varint(bytes, kMiniBlocks);
  add_varint(bytes, values.size());
  add_zigzag(bytes, values.empty() ? 0 : values.front());
  std::array<std::int64_t, kBlock> steps{};
  for (std::size_t begin = 1; begin < values.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, values.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      steps[i] = std::int64_t{values[begin + i]} - values[begin + i - 1];
    }
    add_block(bytes, std::span(steps).first(count));
  }
  return bytes;
}

}  // namespace terracut::cli
