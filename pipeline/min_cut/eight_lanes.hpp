// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "pipeline/min_cut/direction.hpp"

namespace terracut::min_cut {

/// Eight 16-bit numbers, one a neighbour, worked on four at a time inside plain 64-bit words: the
/// same on every machine, and without the branch a neighbour that mispredicts every other time.
struct EightLanes {
  static_assert(std::endian::native == std::endian::little, "lane d must be at bit 16 * d");
  static constexpr std::uint64_t kOnes = 0x0001'0001'0001'0001;  ///< 1 in every lane.
  static constexpr std::uint64_t kSigns = 0x8000'8000'8000'8000;

  std::uint64_t low = 0, high = 0;  ///< Lanes 0..3 and 4..7.

  template <class T>
  [[nodiscard]] static EightLanes load(const std::array<T, kDirections>& numbers) noexcept {
    static_assert(sizeof(T) == 2);
    EightLanes lanes;
    std::memcpy(&lanes.low, numbers.data(), sizeof(low));
    std::memcpy(&lanes.high, numbers.data() + 4, sizeof(high));
    return lanes;
  }
  void store(std::array<std::int16_t, kDirections>& numbers) const noexcept {
    std::memcpy(numbers.data(), &low, sizeof(low));
    std::memcpy(numbers.data() + 4, &high, sizeof(high));
  }

  /// The four bytes of `bytes` as the lanes of a half, the lowest byte first.
  [[nodiscard]] static std::uint64_t widened(std::uint32_t bytes) noexcept {
    const std::uint64_t pairs = (bytes | std::uint64_t{bytes} << 16U) & 0x0000'FFFF'0000'FFFF;
    return (pairs | pairs << 8U) & 0x00FF'00FF'00FF'00FF;
  }

  /// The lanes of `*this` where bit `bit` of the same lane of `flags` is set, 0 in the others.
  [[nodiscard]] EightLanes where(const EightLanes& flags, int bit) const noexcept {
    return {low & (((flags.low >> bit) & kOnes) * 0xFFFF),
            high & (((flags.high >> bit) & kOnes) * 0xFFFF)};
  }
  /// Sum of all lanes; it must fit 16 bits.
  [[nodiscard]] int sum() const noexcept { return static_cast<int>(((low + high) * kOnes) >> 48U); }
  /// Bit d set where lane d is not 0. Lanes must be below 0x8000.
  [[nodiscard]] std::uint8_t nonzero() const noexcept {
    const auto signs = [](std::uint64_t half) { return (half + (kSigns - kOnes)) & kSigns; };
    // Gathers bits 15, 31, 47, 63 in bits 60..63 of the product, which nothing else reaches.
    constexpr std::uint64_t kGather = (1ULL << 45U) | (1ULL << 30U) | (1ULL << 15U) | 1ULL;
    return static_cast<std::uint8_t>((signs(low) * kGather) >> 60U |
                                     (signs(high) * kGather) >> 60U << 4U);
  }
};

}  // namespace terracut::min_cut
