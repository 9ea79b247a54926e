// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <numbers>

namespace terracut::beams {

[[nodiscard]] constexpr double deg_to_rad(double deg) noexcept {
  return deg * (std::numbers::pi / 180.0);
}
[[nodiscard]] constexpr double rad_to_deg(double rad) noexcept {
  return rad * (180.0 / std::numbers::pi);
}

/// One revolution in hundredths of a degree, the unit of azimuths in packets.
inline constexpr int kRevolution_cdeg = 36000;

/// Returns `cdeg` reduced to [0, 36000).
[[nodiscard]] constexpr int wrap_cdeg(std::int64_t cdeg) noexcept {
  const auto rest = static_cast<int>(cdeg % kRevolution_cdeg);
  return rest < 0 ? rest + kRevolution_cdeg : rest;
}

/// Returns the signed step from `from` to `to`, both in [0, 36000), by the shorter way: a value in
/// [-18000, 18000).
[[nodiscard]] constexpr int step_cdeg(int from, int to) noexcept {
  return wrap_cdeg(std::int64_t{to} - from + kRevolution_cdeg / 2) - kRevolution_cdeg / 2;
}

}  // namespace terracut::beams
