// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>

#include "terracut/frame.hpp"

namespace terracut::frame {

/// Finds the azimuths of points in [0, 2 pi) radians, clockwise from straight ahead seen from
/// above, as the image counts its columns. Error below 1e-6 rad. Uses plain IEEE arithmetic,
/// several points at a time: the result is the same on every machine, unlike atan2 of standard
/// libraries. `azimuths_rad` has one element per point; its value is arbitrary for a point that is
/// not finite. Real-time safe.
void find_azimuths(std::span<const CloudPoint> points, std::span<float> azimuths_rad) noexcept;

}  // namespace terracut::frame
