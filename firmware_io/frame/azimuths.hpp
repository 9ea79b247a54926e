// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>

#include "terracut/frame.hpp"

namespace terracut::frame {

/// Azimuths of points in [0, 2 pi) radians, clockwise from straight ahead seen from above, as the
/// image counts its columns; by plain IEEE arithmetic: the same on every machine, which
/// atan2 of standard libraries is not, and several at a time. Error below 1e-6 rad. `azimuths_rad`:
/// one a point; anything for points that are not finite. Real-time safe.
void find_azimuths(std::span<const CloudPoint> points, std::span<float> azimuths_rad) noexcept;

}  // namespace terracut::frame
