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

/// A change of a whole frame that adds no obstacle: ghosts, snow, dirt.
struct Disturbance {
  std::string_view word;  ///< "ghosts_1"
  /// Sets `moved.range_m` for one return; false if the return stays.
  bool (*disturb)(const LabelledFrame& frame, std::uint32_t index, world::Random& random,
                  MovedReturn& moved);
};

/// Returns all disturbances.
[[nodiscard]] std::span<const Disturbance> disturbances() noexcept;

/// Returns the returns that a disturbance moves. `key` decides which ones.
[[nodiscard]] MovedReturns disturbed(const LabelledFrame& frame, const Disturbance& disturbance,
                                     std::uint64_t key);

}  // namespace terracut::hazards
