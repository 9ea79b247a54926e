// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>

#include "sensor_effects.hpp"
#include "tools/lab/world/hit.hpp"
#include "tools/lab/world/random.hpp"

namespace terracut::simulator {

/// What the receiver makes of a surface.
struct Echo {
  double range_error_m = 0;
  std::uint8_t intensity = 0;  ///< Wire scale.
  double signal = 0;           ///< Light that comes back; tells the stronger of two echoes.
};

/// Nothing when the return is lost. `cos_incidence` in [0, 1]; `share` of the beam's light that
/// falls on this surface, (0, 1].
///
/// The chance to see an echo falls with the light that comes back, reflectivity * cos(incidence) /
/// range^2, so that asphalt below a sensor at 1.73 m is lost beyond some 50 m and a bright wall is
/// not at 120 m: the ranges the maker gives for the HDL-64E (pavement 50 m, cars and foliage 120
/// m).
[[nodiscard]] std::optional<Echo> echo_from(const SensorEffects& effects, const world::Hit& hit,
                                            double cos_incidence, world::Random& random,
                                            double share = 1) noexcept;

}  // namespace terracut::simulator
