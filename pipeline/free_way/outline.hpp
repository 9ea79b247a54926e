// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "pipeline/free_way/sector.hpp"
#include "terracut/object.hpp"

namespace terracut::free_way {

/// Returns the corners of the area where ground was seen and nothing stands, counterclockwise,
/// vehicle frame: of each sector, whole, up to Sector::free_m(). Ground below the sensor that is
/// never seen is part of it.
[[nodiscard]] std::vector<Corner> outline(std::span<const Sector> sectors);

/// Returns the direction of a place, clockwise from straight ahead, in turns: [0, 1].
[[nodiscard]] float clockwise_turns(Corner place) noexcept;
/// Returns the sector in such a direction; there must be sectors.
[[nodiscard]] inline const Sector& sector_towards(float turns,
                                                  std::span<const Sector> sectors) noexcept {
  const auto sector = static_cast<std::size_t>(turns * static_cast<float>(sectors.size()));
  return sectors[std::min(sector, sectors.size() - 1)];
}

}  // namespace terracut::free_way
