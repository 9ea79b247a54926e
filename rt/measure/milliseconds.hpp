// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::measure {

/// Converts nanoseconds to milliseconds, cut to whole microseconds: further digits of a measured
/// time are noise.
[[nodiscard]] constexpr double milliseconds(std::int64_t ns) noexcept {
  return static_cast<double>(ns / 1000) / 1000.0;
}

}  // namespace terracut::measure
