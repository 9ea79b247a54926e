// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "terracut/free_way.hpp"

namespace terracut::free_way {

using terracut::SeenEnd;
using Sector = terracut::FreeWaySector;

/// The names of the causes in reports, in lower_snake_case.
inline constexpr std::array<std::string_view, static_cast<std::size_t>(SeenEnd::kCount)>
    kSeenEndNames{"rows", "lost", "obstacle", "drop"};
[[nodiscard]] constexpr std::string_view to_string(SeenEnd end) noexcept {
  return end < SeenEnd::kCount ? kSeenEndNames[static_cast<std::size_t>(end)] : "unknown";
}

}  // namespace terracut::free_way
