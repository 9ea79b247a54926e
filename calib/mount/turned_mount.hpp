// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <span>

#include "calib/mount/mount_estimate.hpp"
#include "rt/error.hpp"

namespace terracut::mount {

/// The mount of a sensor that does not stand as estimate_mount() looks for it: of one that hangs
/// upside down, or is tilted by up to 70 degrees from either. `strip`: as there. `around`: returns
/// of the same frame all around, near and far, in the sensor frame.
///
/// A ceiling above a sensor that stands is as level as the ground. So the ground has to hold half
/// of what is seen before and behind the sensor, to have nothing below it, and the sensor must not
/// see a floor or a ceiling on its other side. A wall beside it is none: of a sensor on its side
/// nothing is believed. kMalformed, with what was seen instead and which option states it.
/// Start-up only: allocates, takes tens of milliseconds. Deterministic.
[[nodiscard]] Expected<MountEstimate> estimate_turned_mount(
    std::span<const std::array<float, 3>> strip, std::span<const std::array<float, 3>> around);

}  // namespace terracut::mount
