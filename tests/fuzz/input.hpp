// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

namespace terracut::fuzz {

/// Ends the program, as a fuzzer's finding, unless this holds.
inline void require(bool holds, std::string_view otherwise = "a requirement does not hold") {
  if (holds) return;
  std::fprintf(stderr, "%.*s\n", static_cast<int>(otherwise.size()), otherwise.data());
  std::abort();
}

/// The bytes of a fuzzer's input, taken one after another; beyond the end all are 0.
class Input {
 public:
  explicit Input(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  /// A number of so many bytes.
  std::uint32_t next(std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count && !bytes_.empty(); ++i) {
      value = value << 8 | bytes_[0];
      bytes_ = bytes_.subspan(1);
    }
    return value;
  }
  /// [0, count), of one byte if that is enough.
  int below(std::uint32_t count) { return static_cast<int>(next(count > 256 ? 2 : 1) % count); }
  std::span<const std::uint8_t> take(std::size_t count) {
    const auto part = bytes_.first(std::min(count, bytes_.size()));
    bytes_ = bytes_.subspan(part.size());
    return part;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// How many returns of a sensor's packet have a distance.
template <class Packet>
[[nodiscard]] std::uint64_t returns_in(const Packet& packet) {
  std::uint64_t sum = 0;
  for (const auto& block : packet.blocks) {
    for (const auto& beam : block.returns) sum += beam.distance.value() != 0 ? 1U : 0U;
  }
  return sum;
}

}  // namespace terracut::fuzz
