// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>

namespace terracut::drive {

/// Head azimuths of the firings that fill whole packets, each in [0, 36000); the last entries are
/// not used where fewer firings do.
using GroupAzimuths = std::array<std::int32_t, 6>;

}  // namespace terracut::drive
