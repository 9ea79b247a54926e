// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>

namespace terracut::object_measures {

/// The number of returns that two partitions of the same returns have in common.
struct Overlaps {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> both;  ///< By part of each.
  std::map<std::uint32_t, std::uint32_t> first, second;                   ///< Sizes of parts.
};

[[nodiscard]] inline Overlaps overlaps(std::span<const std::uint32_t> first,
                                       std::span<const std::uint32_t> second) {
  Overlaps counts;
  for (std::size_t i = 0; i < first.size(); ++i) {
    ++counts.both[{first[i], second[i]}];
    ++counts.first[first[i]];
    ++counts.second[second[i]];
  }
  return counts;
}

}  // namespace terracut::object_measures
