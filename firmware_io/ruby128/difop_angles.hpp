// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/beams/beam_table.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"
#include "firmware_io/ruby128/difop.hpp"
#include "rt/error.hpp"

namespace terracut::ruby128 {

/// Returns the unit's calibration from its DIFOP packet, exactly as sent in hundredths of a degree.
/// Fails with kNoCalibration if the angles were never written into the unit (a sign is 0xFF, or all
/// elevations are zero), kMalformed or kUnsupported (a Ruby Plus) if they are implausible; the
/// message says what to do. Allocates.
[[nodiscard]] Expected<Ruby128Calibration> calibration_of(const ruby128_wire::Difop& difop);

/// The same for a RoboSense with 32 lasers (robosense::kLayouts), whose angles take the place of
/// the first 64 elevations.
[[nodiscard]] Expected<beams::BeamTable> table_of(const ruby128_wire::Difop& difop,
                                                  sensor::SensorModel model);

/// Writes the angles into the packet, rounded by angle_cdeg(). Angles beyond 655.35 degrees, and
/// NaN, are written as that limit.
void set_calibration(ruby128_wire::Difop& difop, const Ruby128Calibration& calibration) noexcept;
/// The same for a RoboSense with 32 lasers, rounded to its unit.
void set_table(ruby128_wire::Difop& difop, const beams::BeamTable& table) noexcept;

}  // namespace terracut::ruby128
