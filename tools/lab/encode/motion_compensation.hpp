// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "firmware_io/scan/kitti_scan.hpp"
#include "tools/lab/encode/sensor_motion.hpp"

namespace terracut::encode {

/// Restores the sensor's motion in a compensated scan: gives the points as the sensor measured
/// them.
///
/// KITTI's scans look as if all points had been measured at the instant when the head looked
/// straight ahead. The direction of rotation and the start of a frame were found from the scans in
/// shared/data: of clockwise or counter-clockwise, seam in front or behind, only "clockwise seen
/// from above, seam behind" makes the points of each laser fall onto a line; the other three are
/// worse than unchanged scans (seven scans of five sequences). Shifting the phase by 0.02 of a
/// frame or the speed by 5 % does not help consistently. So a point at azimuth a (clockwise,
/// -180..180 degrees) was measured a / 360 of a frame after that instant, and
///
///    p_sensor = exp(-time(a) * twist) * p_file,   a = azimuth of p_sensor, found by iteration.
///
/// Height residual (95 %) of the 18 scans, each with a fit of its own: 5.9..11.6 cm before,
/// 0.4..2.1 cm after in 16 of them; frames 8 and 9 of sequence 00 keep 3.4 and 5.4 cm, at far
/// points behind the car. Without the poses' roll and pitch these two fall to 1.4 and 1.7 cm, but
/// the mean of all rises (1.5 to 1.7 cm), so the whole twist is used.
///
/// Two errors remain, because the files lack the data to remove them: the lasers' rotational
/// corrections (up to 10 degrees, 3 ms) and changes of speed within two frames. Points without a
/// valid position are not changed. Allocates nothing.
void undo_motion_compensation(const SensorTwist& twist, std::span<scan::ScanPoint> points) noexcept;

}  // namespace terracut::encode
