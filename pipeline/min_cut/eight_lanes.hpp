// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "pipeline/min_cut/direction.hpp"

namespace terracut::min_cut {

/// Eight 16-bit numbers, one for each neighbour, that are processed together. A branch for each
/// number would be mispredicted every other time. Every supported machine has registers of this
/// width.
struct EightLanes {
  static_assert(std::endian::native == std::endian::little, "lane d must be at bit 16 * d");
  using Numbers = std::int16_t __attribute__((vector_size(16)));

  Numbers lanes = {};

  template <class T>
  [[nodiscard]] static EightLanes load(const std::array<T, kDirections>& numbers) noexcept {
    static_assert(sizeof(numbers) == sizeof(Numbers));
    EightLanes eight;
    std::memcpy(&eight.lanes, numbers.data(), sizeof(numbers));
    return eight;
  }
  void store(std::array<std::int16_t, kDirections>& numbers) const noexcept {
    std::memcpy(numbers.data(), &lanes, sizeof(lanes));
  }

  /// Widens the four bytes of `low`, lowest first, then those of `high`, to lanes.
  [[nodiscard]] static EightLanes widened(std::uint32_t low, std::uint32_t high) noexcept {
    using Bytes = std::uint8_t __attribute__((vector_size(16)));
    using Pairs = std::uint32_t __attribute__((vector_size(16)));
    const auto narrow = reinterpret_cast<Bytes>(Pairs{low, high, 0, 0});
    return {reinterpret_cast<Numbers>(__builtin_shufflevector(narrow, Bytes{}, 0, 16, 1, 17, 2, 18,
                                                              3, 19, 4, 20, 5, 21, 6, 22, 7, 23))};
  }

  /// Returns `*this` with 0 in all lanes for which the same lane of `flags` has none of `bits`.
  [[nodiscard]] EightLanes where(const EightLanes& flags, std::int16_t bits) const noexcept {
    return {lanes & ((flags.lanes & bits) != 0)};
  }
  /// Returns the lanes, taken as unsigned, limited to `most`.
  [[nodiscard]] EightLanes at_most(std::uint16_t most) const noexcept {
    using Unsigned = std::uint16_t __attribute__((vector_size(16)));
    const auto given = reinterpret_cast<Unsigned>(lanes);
    const Unsigned limit = most - Unsigned{};
    return {reinterpret_cast<Numbers>(given < limit ? given : limit)};
  }
  /// Returns the sum of all lanes; it must fit 16 bits, and no lane may be negative.
  [[nodiscard]] int sum() const noexcept {
    constexpr std::uint64_t kOnes = 0x0001'0001'0001'0001;  // 1 in every lane
    const auto words = reinterpret_cast<Words>(lanes);
    return static_cast<int>(((words[0] + words[1]) * kOnes) >> 48U);
  }
  /// Returns a mask in which bit d is set if lane d is not 0.
  [[nodiscard]] std::uint8_t nonzero() const noexcept {
    constexpr Numbers kBits = {1, 2, 4, 8, 16, 32, 64, 128};
    return static_cast<std::uint8_t>(EightLanes{kBits & (lanes != 0)}.sum());
  }

 private:
  using Words = std::uint64_t __attribute__((vector_size(16)));
};

}  // namespace terracut::min_cut
