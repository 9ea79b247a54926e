// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace terracut::packets {

/// Head azimuths of the firings that fill whole packets, each in [0, 36000).
struct GroupAzimuths {
  std::array<std::int32_t, 16> cdeg{};      ///< The last are unused if fewer firings suffice.
  std::optional<std::int32_t> before_cdeg;  ///< Azimuth of the previous firing; none at the start.
};

}  // namespace terracut::packets
