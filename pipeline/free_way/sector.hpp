// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

namespace terracut::free_way {

/// Why ground is seen no farther without a gap.
enum class SeenEnd : std::uint8_t {
  kRows,      ///< The next row meets the ground too far behind: no beam looks between.
  kLost,      ///< Beams between returned nothing: water, black ice, a crest, an open hole.
  kObstacle,  ///< An obstacle stands there.
  kDrop,      ///< The next ground lies much lower: a hole, a step down.
  kCount,
};

/// The names of the causes in reports, in lower_snake_case.
inline constexpr std::array<std::string_view, static_cast<std::size_t>(SeenEnd::kCount)>
    kSeenEndNames{"rows", "lost", "obstacle", "drop"};
[[nodiscard]] constexpr std::string_view to_string(SeenEnd end) noexcept {
  return end < SeenEnd::kCount ? kSeenEndNames[static_cast<std::size_t>(end)] : "unknown";
}

/// What lies in one direction. Distances are horizontal, from the frame's origin below the sensor.
struct Sector {
  /// To the nearest obstacle; infinity if there is none.
  float obstacle_m = std::numeric_limits<float>::infinity();
  float seen_m = 0;  ///< Up to here ground was seen without a gap; 0: from the beginning not.
  SeenEnd seen_end = SeenEnd::kRows;

  /// Returns up to where ground was seen and nothing stands.
  [[nodiscard]] constexpr float free_m() const noexcept {
    return obstacle_m < seen_m ? obstacle_m : seen_m;
  }
};

}  // namespace terracut::free_way
