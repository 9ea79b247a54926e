// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace terracut::encode {

inline constexpr std::size_t kNoFiring = SIZE_MAX;

/// Assigns the returns of one laser to firings in order, one each, at most `farthest_ticks` from
/// its azimuth. It places as many returns as possible and among such assignments takes one with the
/// least sum of squared shifts (an alignment of two sorted lists, by dynamic programming).
///
/// `wanted_ticks` (of the returns) and `fired_ticks` (of the laser's firings) are sorted azimuths
/// in 1e-5 degrees. Returns the index of its firing for every return, or kNoFiring. Allocates.
[[nodiscard]] std::vector<std::size_t> assign_firings(std::span<const std::int64_t> wanted_ticks,
                                                      std::span<const std::int64_t> fired_ticks,
                                                      std::int64_t farthest_ticks);

}  // namespace terracut::encode
