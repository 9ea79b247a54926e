// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace terracut::encode {

inline constexpr std::size_t kNoFiring = SIZE_MAX;

/// Assigns the returns of one laser to its firings, in order, at most one return per firing, and at
/// most `farthest_ticks` from the return's azimuth. It places as many returns as possible and, of
/// all ways to do so, takes one with the least sum of squared shifts (an alignment of two sorted
/// lists, by dynamic programming).
///
/// `wanted_ticks` (of the returns) and `fired_ticks` (of the firings) are sorted azimuths in 1e-5
/// degrees. Returns for every return the index of its firing, or kNoFiring. Allocates.
[[nodiscard]] std::vector<std::size_t> assign_firings(std::span<const std::int64_t> wanted_ticks,
                                                      std::span<const std::int64_t> fired_ticks,
                                                      std::int64_t farthest_ticks);

}  // namespace terracut::encode
