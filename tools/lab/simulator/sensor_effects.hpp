// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

namespace terracut::simulator {

/// Imperfections of a real sensor.
struct SensorEffects {
  double range_noise_m = 0.015;      ///< Standard deviation, on every surface; [0, 1].
  bool rough_surfaces = true;        ///< Grass, gravel and leaves add depth noise.
  double random_drop_share = 0.005;  ///< Share of returns lost at random; [0, 1].
  bool weak_drop = true;             ///< Far, dark, slanting and glossy surfaces lose returns.
  double min_range_m = 0.9;          ///< Nearer and farther echoes are not reported.
  double max_range_m = 120.0;

  /// Returns effects without any imperfection: only the range limits remain.
  [[nodiscard]] static constexpr SensorEffects none() noexcept {
    return {
        .range_noise_m = 0, .rough_surfaces = false, .random_drop_share = 0, .weak_drop = false};
  }
};

}  // namespace terracut::simulator
