// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace terracut {

/// A place on the ground, vehicle frame (calibration.hpp), metres.
struct Corner {
  float x_m = 0, y_m = 0;
};

/// A convex polygon, counterclockwise. Its corners are the object's outermost returns in 16
/// directions; returns between two of them may lie outside by up to a tenth of that side.
struct Footprint {
  static constexpr std::size_t kMostCorners = 16;
  std::array<Corner, kMostCorners> corners{};
  std::uint32_t count = 0;  ///< At least 1.

  [[nodiscard]] std::span<const Corner> span() const noexcept {
    return std::span(corners).first(count);
  }
};

/// The smallest rectangle around a footprint.
struct Box {
  Corner middle;
  Corner along{1, 0};  ///< Direction of the longer side, length 1.
  float length_m = 0, width_m = 0;

  /// Returns its corners, counterclockwise.
  [[nodiscard]] std::array<Corner, 4> corners() const noexcept {
    const auto corner = [this](float ahead, float aside) -> Corner {
      const float ahead_m = ahead * length_m / 2, aside_m = aside * width_m / 2;
      return {middle.x_m + ahead_m * along.x_m - aside_m * along.y_m,
              middle.y_m + ahead_m * along.y_m + aside_m * along.x_m};
    };
    return {corner(1, 1), corner(-1, 1), corner(-1, -1), corner(1, -1)};
  }
};

/// Returns that belong together and stand out of the ground.
struct Object {
  std::uint32_t returns = 0;
  std::uint32_t first_return = 0;  ///< Lowest and highest return index, in order of arrival.
  std::uint32_t last_return = 0;
  float bottom_m = 0;  ///< Heights of the lowest and the highest return above the ground.
  float top_m = 0;
  float ground_z_m = 0;  ///< Height of the ground below it, vehicle frame.
  Footprint footprint;
  Box box;
};

}  // namespace terracut
