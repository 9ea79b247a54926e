// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "tools/lab/world/random.hpp"

namespace terracut::simulation {

/// Whole random numbers by seed, the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) noexcept : random_(seed) {}

  /// Returns a number in [least, most].
  [[nodiscard]] std::int64_t between(std::int64_t least, std::int64_t most) noexcept {
    const auto count = static_cast<std::uint64_t>(most - least + 1);
    return least + static_cast<std::int64_t>(random_.bits() % count);
  }
  /// Returns a number in [1, most], each power of two as likely as another.
  [[nodiscard]] std::int64_t of_any_size(std::int64_t most) noexcept {
    std::int64_t powers = 0;
    while ((most >> powers) > 1) ++powers;
    const std::int64_t least = std::int64_t{1} << between(0, powers);
    return between(least, least * 2 - 1 < most ? least * 2 - 1 : most);
  }

 private:
  world::Random random_;
};

}  // namespace terracut::simulation
