// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "calib/ruby128/ruby128_calibration.hpp"
#include "firmware_io/ruby128/difop.hpp"
#include "rt/error.hpp"

namespace terracut::ruby128 {

/// What the angles of a DIFOP are good for.
enum class DifopAngles : std::uint8_t {
  kPlausible,    ///< validate() would pass.
  kUnset,        ///< Never written into the unit: a sign is 0xFF, or all elevations are zero.
  kImplausible,  ///< Anything else.
};

/// No allocation, a few tens of microseconds.
[[nodiscard]] DifopAngles judge_angles(const ruby128_wire::Difop& difop) noexcept;

/// The unit's calibration out of its DIFOP, exactly the hundredths of a degree that stand there, or
/// why there is none: kNoCalibration for kUnset, and kMalformed or kUnsupported (a Ruby Plus) for
/// kImplausible. The message says what to do. Allocates.
[[nodiscard]] Expected<Ruby128Calibration> calibration_of(const ruby128_wire::Difop& difop);

/// Puts the angles into the packet, rounded by angle_cdeg(); beyond 655.35 degrees, and NaN,
/// at that end.
void set_calibration(ruby128_wire::Difop& difop, const Ruby128Calibration& calibration) noexcept;

}  // namespace terracut::ruby128
