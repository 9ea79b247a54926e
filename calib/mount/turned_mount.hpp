// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <span>

#include "calib/mount/mount_estimate.hpp"
#include "rt/error.hpp"

namespace terracut::mount {

/// Returns the mount of a sensor that hangs upside down, or is tilted by up to 70 degrees from
/// upright or upside down, where estimate_mount() does not look. `strip` holds the points for
/// estimate_mount(), `around` the returns of the same frame in all directions, near and far, in the
/// sensor frame.
///
/// A ceiling above a sensor is as level as the ground. So the ground must hold half of the strip's
/// points and have nothing below it, and there must be no floor or ceiling on the sensor's other
/// side. A sensor on its side is never accepted: its ground may be a wall. Fails with kMalformed;
/// the message says what was seen and which option states the mount. Start-up only: allocates,
/// takes tens of milliseconds. Deterministic.
[[nodiscard]] Expected<MountEstimate> estimate_turned_mount(
    std::span<const std::array<float, 3>> strip, std::span<const std::array<float, 3>> around);

}  // namespace terracut::mount
