// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>

namespace terracut::frame {

/// Size of a range image.
struct ImageShape {
  int rows = 64;       ///< Number of lasers; row 0 has the lowest elevation.
  int columns = 2083;  ///< Columns in 360 degrees; column 0 starts straight ahead, then clockwise.

  /// Returns the number of cells from one row to the next: columns rounded up to a multiple of 16,
  /// for SIMD loads.
  [[nodiscard]] constexpr int stride() const noexcept { return (columns + 15) / 16 * 16; }
  [[nodiscard]] constexpr std::size_t cells() const noexcept {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(stride());
  }
  [[nodiscard]] constexpr std::size_t cell(int row, int column) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(stride()) +
           static_cast<std::size_t>(column);
  }
  /// Returns the width of a column in degrees of azimuth.
  [[nodiscard]] constexpr double pitch_deg() const noexcept { return 360.0 / columns; }
};

/// Adjacent columns [begin, end), which do not cross the seam.
struct ColumnRange {
  int begin, end;
  [[nodiscard]] constexpr std::size_t size() const noexcept {
    return static_cast<std::size_t>(end - begin);
  }
};

}  // namespace terracut::frame
