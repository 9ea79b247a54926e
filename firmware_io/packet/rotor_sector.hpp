// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>

namespace terracut::packet {

/// An interval [from, to) of the head's azimuth, which counts on over revolutions, in ticks.
struct RotorInterval {
  std::int64_t from_ticks = 0, to_ticks = 0;

  [[nodiscard]] constexpr std::int64_t ticks() const noexcept {
    return std::max<std::int64_t>(0, to_ticks - from_ticks);
  }
};

[[nodiscard]] constexpr RotorInterval intersection(const RotorInterval& a,
                                                   const RotorInterval& b) noexcept {
  return {std::max(a.from_ticks, b.from_ticks), std::min(a.to_ticks, b.to_ticks)};
}
[[nodiscard]] constexpr RotorInterval shifted(const RotorInterval& interval,
                                              std::int64_t ticks) noexcept {
  return {interval.from_ticks + ticks, interval.to_ticks + ticks};
}

/// An interval of azimuth that recurs in every revolution, or none.
struct RotorSector {
  RotorInterval once;  ///< The interval in one revolution, shorter than a revolution.
  std::int64_t revolution_ticks = 1;  ///< Ticks in a revolution, > 0.

  [[nodiscard]] constexpr bool is_none() const noexcept { return once.ticks() == 0; }
  /// Returns the first occurrence of the interval that ends after `rotor_ticks`.
  [[nodiscard]] constexpr RotorInterval next(std::int64_t rotor_ticks) const noexcept {
    return shifted(once, (frames_before(rotor_ticks - once.to_ticks) + 1) * revolution_ticks);
  }
  /// Returns how much of `interval` lies outside the sector.
  [[nodiscard]] constexpr std::int64_t outside_ticks(const RotorInterval& interval) const noexcept {
    return interval.ticks() == 0 ? 0
                                 : interval.ticks() - (inside_until(interval.to_ticks) -
                                                       inside_until(interval.from_ticks));
  }

 private:
  [[nodiscard]] constexpr std::int64_t frames_before(std::int64_t ticks) const noexcept {
    return ticks / revolution_ticks - (ticks % revolution_ticks < 0 ? 1 : 0);
  }
  /// Returns the total width of the sector's occurrences from `once` on up to `rotor_ticks`;
  /// negative before `once`.
  [[nodiscard]] constexpr std::int64_t inside_until(std::int64_t rotor_ticks) const noexcept {
    const std::int64_t frames = frames_before(rotor_ticks - once.from_ticks);
    const std::int64_t in_frame = rotor_ticks - once.from_ticks - frames * revolution_ticks;
    return frames * once.ticks() + std::min(in_frame, once.ticks());
  }
};

}  // namespace terracut::packet
