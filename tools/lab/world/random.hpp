// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace terracut::world {

/// Scrambles 64 bits so that neighbouring inputs give unrelated outputs (the finaliser of
/// splitmix64).
[[nodiscard]] constexpr std::uint64_t scramble(std::uint64_t bits) noexcept {
  bits += 0x9E3779B97F4A7C15U;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9U;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBU;
  return bits ^ (bits >> 31);
}

/// Combines two keys into one that depends on their order.
[[nodiscard]] constexpr std::uint64_t mix_keys(std::uint64_t a, std::uint64_t b) noexcept {
  return scramble(scramble(a) ^ (b * 0xD6E8FEB86659FD93U + 0x2545F4914F6CDD1DU));
}

/// Returns a number in [0, 1) from scrambled bits.
[[nodiscard]] constexpr double unit_interval(std::uint64_t bits) noexcept {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// Seeded random numbers, the same on every platform (the distributions of <random> are not).
///
/// Constructed from a key for each object or ray, so that no number depends on numbers drawn
/// elsewhere: adding an object or a thread changes nothing else. Draw at most once among a call's
/// arguments, as their order of evaluation differs between compilers.
class Random {
 public:
  explicit constexpr Random(std::uint64_t key) noexcept : key_(scramble(key)) {}

  [[nodiscard]] constexpr std::uint64_t bits() noexcept {
    return scramble(key_ ^ scramble(count_++));
  }
  /// Returns a number in [0, 1).
  [[nodiscard]] constexpr double unit() noexcept { return unit_interval(bits()); }
  /// Returns a number in [low, high).
  [[nodiscard]] constexpr double uniform(double low, double high) noexcept {
    return low + (high - low) * unit();
  }
  [[nodiscard]] constexpr bool chance(double probability) noexcept { return unit() < probability; }
  /// Returns one of 0 .. count - 1.
  [[nodiscard]] constexpr int pick(int count) noexcept {
    return static_cast<int>(unit() * static_cast<double>(count));
  }
  /// Returns a normal variable with mean 0, standard deviation 1 (Box and Muller).
  [[nodiscard]] double normal() noexcept {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - unit()));
    return radius * std::cos(2.0 * std::numbers::pi * unit());
  }

 private:
  std::uint64_t key_;
  std::uint64_t count_ = 0;
};

}  // namespace terracut::world
