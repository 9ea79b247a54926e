// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/sensor_motion.hpp"

namespace terracut::firmware_io {

/// Puts the sensor's motion back into a compensated scan: points as the sensor itself measured
/// them.
///
/// KITTI's scans are given as if all points had been measured at the instant when the head looked
/// straight ahead. What that instant is and which way the head turns was found from the scans in
/// shared/data: of clockwise or counter-clockwise, with the turn's seam in front or behind, only
/// "clockwise seen from above, seam behind" makes the points of each laser fall onto a line: it
/// brings the height residual (95 %) of moving scans from 6..10 cm to 0.5..2 cm, each of the others
/// raises it (docs/method.md). The phase is right to 0.02 of a turn. So a point at azimuth a
/// (clockwise, -180..180 degrees) was measured a / 360 of a turn after that instant, and
///
///   p_sensor = exp(-time(a) * twist) * p_file,   a = azimuth of p_sensor, found by iteration.
///
/// What is not in the files, and so remains: the lasers' rotational corrections (up to 9 degrees, 2
/// ms) and changes of speed within two turns. Points that are not finite stay as they are.
/// Allocates nothing.
void undo_motion_compensation(const SensorTwist& twist, std::span<ScanPoint> points) noexcept;

}  // namespace terracut::firmware_io
