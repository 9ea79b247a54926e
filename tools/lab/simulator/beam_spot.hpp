// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "tools/lab/world/hit.hpp"

namespace terracut::simulator {

/// A second line inside a beam, which stands for the light beside its axis: it may pass by what the
/// axis meets, or meet what the axis passes by.
struct SideLine {
  world::SightLine line;
  double share = 0;           ///< Light that goes its way for each that goes along the axis.
  std::uint64_t ray_key = 0;  ///< Of the leaves and wires it meets: not those of the axis.
};

/// At a random place of the beam's disc of light, the same for the same `ray_key` of the axis.
[[nodiscard]] SideLine side_line(const world::SightLine& axis, double half_width_rad,
                                 std::uint64_t ray_key) noexcept;

/// Whether the light from two places comes back as one echo: from one surface, or from two so near
/// to each other in range that the receiver cannot tell their pulses apart.
[[nodiscard]] bool one_echo(const world::SightLine& axis, const world::Hit& on_axis,
                            const world::SightLine& side, const world::Hit& on_side) noexcept;

}  // namespace terracut::simulator
