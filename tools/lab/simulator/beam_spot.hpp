// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "tools/lab/world/hit.hpp"

namespace terracut::simulator {

/// A second line inside a beam, for the light beside its axis: it may miss what the axis meets, or
/// meet something that the axis misses.
struct SideLine {
  world::SightLine line;
  double share = 0;           ///< Its light relative to that along the axis.
  std::uint64_t ray_key = 0;  ///< Its own key, for random leaves and wires.
};

/// Returns a line at a random position in the beam's disc. The same `ray_key` (that of the axis)
/// gives the same line.
[[nodiscard]] SideLine side_line(const world::SightLine& axis, double half_width_rad,
                                 std::uint64_t ray_key) noexcept;

/// True if the light from two places comes back as one echo: they are on one surface, or their
/// ranges are too close for separate pulses.
[[nodiscard]] bool one_echo(const world::SightLine& axis, const world::Hit& on_axis,
                            const world::SightLine& side, const world::Hit& on_side) noexcept;

}  // namespace terracut::simulator
