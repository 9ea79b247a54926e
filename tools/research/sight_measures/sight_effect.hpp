// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "pipeline/visibility/visibility.hpp"
#include "tools/research/hazards/labelled_frame.hpp"
#include "tools/research/hazards/moved_return.hpp"

namespace terracut::sight_measures {

/// Something that lets a sensor see less.
struct SightEffect {
  std::string_view word;      ///< "fog_30m"
  visibility::Cause cause{};  ///< What it is to be named.
  /// Returns the returns that it moves or removes. `place` decides where it is, and stays from turn
  /// to turn; `turn` decides what differs from turn to turn.
  hazards::MovedReturns (*apply)(const hazards::LabelledFrame& frame, std::uint64_t place,
                                 std::uint64_t turn);
};

/// Returns all effects:
///
///   hand_40   a hand before the lens: 40 degrees return nothing
///   mud_30    mud on 30 degrees: 97 % of the beams return nothing, always the same ones
///   dirt_10   spots on the lens, in all 10 % of the beams
///   fog_30m   fog with a visual range of 30 m: returns fade with distance, droplets return near
///             beams
///   spray     a lorry's spray 6 to 14 m ahead (hazards::disturbances())
///   snow      snowfall: one beam in ten ends at a flake (hazards::disturbances())
[[nodiscard]] std::span<const SightEffect> sight_effects() noexcept;

}  // namespace terracut::sight_measures
