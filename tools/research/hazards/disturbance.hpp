// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "labelled_frame.hpp"
#include "moved_return.hpp"
#include "tools/lab/world/random.hpp"

namespace terracut::hazards {

/// What disturbs a whole frame and is no obstacle.
struct Disturbance {
  std::string_view word;   ///< "ghosts_1"
  std::string_view about;  ///< What it does, for people.
  /// What it makes of one return: true if `moved` was filled. Returns are asked in order.
  bool (*disturb)(const LabelledFrame& frame, std::uint32_t index, world::Random& random,
                  MovedReturn& moved);
};

/// Returns all disturbances.
[[nodiscard]] std::span<const Disturbance> disturbances() noexcept;

/// Returns the returns that a disturbance moves; `key` decides which.
[[nodiscard]] MovedReturns disturbed(const LabelledFrame& frame, const Disturbance& disturbance,
                                     std::uint64_t key);

}  // namespace terracut::hazards
