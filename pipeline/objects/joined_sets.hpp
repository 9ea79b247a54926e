// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace terracut::objects {

/// Union-find over numbered things: `earlier` has for each thing one of its set with a smaller
/// number, and for the first thing of a set its own number. Returns the first thing of a set, and
/// halves the path to it.
[[nodiscard]] inline std::uint32_t first_of_set(std::span<std::uint32_t> earlier,
                                                std::uint32_t thing) noexcept {
  while (earlier[thing] != thing) {
    earlier[thing] = earlier[earlier[thing]];
    thing = earlier[thing];
  }
  return thing;
}

/// Joins two sets, each named by its first thing.
inline void join_sets(std::span<std::uint32_t> earlier, std::uint32_t a, std::uint32_t b) noexcept {
  earlier[std::max(a, b)] = std::min(a, b);
}

}  // namespace terracut::objects
