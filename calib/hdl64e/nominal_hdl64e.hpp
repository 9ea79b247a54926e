// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/hdl64e/hdl64e_calibration.hpp"

namespace terracut::hdl64e {

/// Returns a made-up but typical HDL-64E for simulation and tests; no real unit has this table, so
/// never decode a recording with it.
///
/// Made by formula: lasers 0..31 (upper block) from +2 to -8.3 deg in steps of about 1/3 deg,
/// lasers 32..63 (lower block) from -8.8 to -24.9 deg in steps of about 1/2 deg, numbered out of
/// order as in real units; rotational corrections over +-8.8 deg, horizontal offsets
/// +-26 mm, vertical offsets 144 to 215 mm, distance corrections 1.1 to 1.5 m with two-point
/// values. Every value is a whole number of the packet stream's units (0.01 deg, 1 mm, 0.1), so
/// that file and stream give the same fingerprint().
[[nodiscard]] Hdl64eCalibration nominal_hdl64e();

}  // namespace terracut::hdl64e
