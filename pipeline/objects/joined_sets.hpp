// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace terracut::objects {

/// Sets of things that are joined again and again: of each thing `earlier` has one of the same set,
/// no later than itself; the first thing of a set has itself. Returns the first one of a thing's
/// set, and shortens the way to it.
[[nodiscard]] inline std::uint32_t first_of_set(std::span<std::uint32_t> earlier,
                                                std::uint32_t thing) noexcept {
  while (earlier[thing] != thing) {
    earlier[thing] = earlier[earlier[thing]];
    thing = earlier[thing];
  }
  return thing;
}

/// Joins two sets, each given by its first thing.
inline void join_sets(std::span<std::uint32_t> earlier, std::uint32_t a, std::uint32_t b) noexcept {
  earlier[std::max(a, b)] = std::min(a, b);
}

}  // namespace terracut::objects
