// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "echo.hpp"

#include <algorithm>
#include <cmath>

namespace terracut::simulator {
namespace {

// Per square metre; with this signal half of the echoes are seen.
constexpr double kHalfSeenSignal = 1.5e-6;
constexpr double kSignalSpread = 0.35;  // Spread of the logarithm around that.

bool is_seen(double signal, world::Random& random) noexcept {
  if (signal <= 0) return false;
  const double excess = std::log(signal / kHalfSeenSignal) / kSignalSpread;
  return random.chance(1.0 / (1.0 + std::exp(-excess)));
}

}  // namespace

std::optional<Echo> echo_from(const SensorEffects& effects, const world::Hit& hit,
                              double cos_incidence, world::Random& random, double share) noexcept {
  const world::MaterialProperties surface = world::properties(hit.material);
  const double signal = share * surface.reflectivity * cos_incidence / (hit.way_m * hit.way_m);
  if (effects.weak_drop && (random.chance(surface.drop_share) || !is_seen(signal, random))) {
    return std::nullopt;
  }
  if (random.chance(effects.random_drop_share)) return std::nullopt;

  double noise_m = effects.range_noise_m;
  if (effects.rough_surfaces) noise_m = std::hypot(noise_m, surface.roughness_m);
  // The sensor raises its power with distance, so the intensity depends more on the surface than on
  // the range.
  const double brightness = share * surface.reflectivity * (0.4 + 0.6 * cos_incidence);
  const double intensity = 255.0 * (0.04 + 0.75 * brightness) + 5.0 * random.normal();
  return Echo{noise_m * random.normal(),
              static_cast<std::uint8_t>(std::lround(std::clamp(intensity, 0.0, 255.0))), signal};
}

}  // namespace terracut::simulator
