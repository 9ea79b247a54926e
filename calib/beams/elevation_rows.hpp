// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>

namespace terracut::beams {

/// Returns the rank of each elevation: 0 for the lowest, N - 1 for the highest. Equal elevations
/// are ranked by index.
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

/// Returns the inverse of `rows`: at rank r, the index of the laser with that rank.
template <std::size_t N>
[[nodiscard]] constexpr std::array<int, N> order_of_rows(const std::array<int, N>& rows) noexcept {
  std::array<int, N> order{};
  for (std::size_t i = 0; i < N; ++i) {
    order[static_cast<std::size_t>(rows[i])] = static_cast<int>(i);
  }
  return order;
}

}  // namespace terracut::beams
