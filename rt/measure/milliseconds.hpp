// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::measure {

/// Rounds to the microsecond, towards zero: further digits of a measured time are only noise.
[[nodiscard]] constexpr double milliseconds(std::int64_t ns) noexcept {
  return static_cast<double>(ns / 1000) / 1000.0;
}

}  // namespace terracut::measure
