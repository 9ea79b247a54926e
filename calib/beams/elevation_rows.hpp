// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>

namespace terracut::beams {

/// Ranks of elevations: 0 the lowest, N - 1 the highest; the lower index first where equal.
template <std::size_t N>
[[nodiscard]] constexpr std::array<int, N> rows_of_elevations(
    const std::array<double, N>& elevation_rad) noexcept {
  std::array<int, N> rows{};
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) {
      const double below = elevation_rad[j], here = elevation_rad[i];
      rows[i] += below < here || (below == here && j < i) ? 1 : 0;
    }
  }
  return rows;
}

/// The inverse: which index has rank 0, 1, ...
template <std::size_t N>
[[nodiscard]] constexpr std::array<int, N> order_of_rows(const std::array<int, N>& rows) noexcept {
  std::array<int, N> order{};
  for (std::size_t i = 0; i < N; ++i) {
    order[static_cast<std::size_t>(rows[i])] = static_cast<int>(i);
  }
  return order;
}

}  // namespace terracut::beams
