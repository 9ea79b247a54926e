// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>

#include "sensor_effects.hpp"
#include "tools/lab/world/hit.hpp"
#include "tools/lab/world/random.hpp"

namespace terracut::simulator {

/// What the receiver measures of a surface.
struct Echo {
  double range_error_m = 0;
  std::uint8_t intensity = 0;  ///< As on the wire.
  double signal = 0;           ///< Light that comes back; decides which of two echoes is stronger.
};

/// Returns the echo; nothing if the return is lost. `cos_incidence` is in [0, 1]; `share` is the
/// part of the beam's light that falls on this surface, (0, 1].
///
/// The probability of an echo falls with the returned light, reflectivity * cos(incidence) /
/// range^2. With a sensor at 1.73 m asphalt is lost beyond some 50 m, a bright wall is still seen
/// at 120 m: the maker's ranges of the HDL-64E (pavement 50 m, cars and foliage 120 m).
[[nodiscard]] std::optional<Echo> echo_from(const SensorEffects& effects, const world::Hit& hit,
                                            double cos_incidence, world::Random& random,
                                            double share = 1) noexcept;

}  // namespace terracut::simulator
