// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>

namespace terracut::decode {

/// Head azimuth, unwrapped (it grows by one turn a turn), in the ticks of the sensor's decoder.
/// An interval of it: [from, to).
struct HeadInterval {
  std::int64_t from_ticks = 0, to_ticks = 0;

  [[nodiscard]] constexpr std::int64_t ticks() const noexcept {
    return std::max<std::int64_t>(0, to_ticks - from_ticks);
  }
};

[[nodiscard]] constexpr HeadInterval intersection(const HeadInterval& a,
                                                  const HeadInterval& b) noexcept {
  return {std::max(a.from_ticks, b.from_ticks), std::min(a.to_ticks, b.to_ticks)};
}
[[nodiscard]] constexpr HeadInterval shifted(const HeadInterval& interval,
                                             std::int64_t ticks) noexcept {
  return {interval.from_ticks + ticks, interval.to_ticks + ticks};
}

/// An interval that comes again every turn, or none.
struct HeadSector {
  HeadInterval once;            ///< In any turn; shorter than one.
  std::int64_t turn_ticks = 1;  ///< > 0

  [[nodiscard]] constexpr bool is_none() const noexcept { return once.ticks() == 0; }
  /// The one that ends next behind `head_ticks`.
  [[nodiscard]] constexpr HeadInterval next(std::int64_t head_ticks) const noexcept {
    return shifted(once, (turns_before(head_ticks - once.to_ticks) + 1) * turn_ticks);
  }
  /// How much of `interval` lies outside.
  [[nodiscard]] constexpr std::int64_t outside_ticks(const HeadInterval& interval) const noexcept {
    return interval.ticks() == 0 ? 0
                                 : interval.ticks() - (inside_until(interval.to_ticks) -
                                                       inside_until(interval.from_ticks));
  }

 private:
  [[nodiscard]] constexpr std::int64_t turns_before(std::int64_t ticks) const noexcept {
    return ticks / turn_ticks - (ticks % turn_ticks < 0 ? 1 : 0);
  }
  /// All that lies inside from `once` on; before it, negative.
  [[nodiscard]] constexpr std::int64_t inside_until(std::int64_t head_ticks) const noexcept {
    const std::int64_t turns = turns_before(head_ticks - once.from_ticks);
    const std::int64_t in_turn = head_ticks - once.from_ticks - turns * turn_ticks;
    return turns * once.ticks() + std::min(in_turn, once.ticks());
  }
};

}  // namespace terracut::decode
