// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::packets {

/// How many returns of a pulse a sensor sends.
enum class ReturnMode : std::uint8_t {
  kSingle,  ///< The strongest return.
  kDual,    ///< The strongest and the last return, which may be the same.
};

[[nodiscard]] constexpr int returns_per_firing(ReturnMode mode) noexcept {
  return mode == ReturnMode::kDual ? 2 : 1;
}

}  // namespace terracut::packets
