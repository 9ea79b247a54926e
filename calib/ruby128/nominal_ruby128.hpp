// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/ruby128/ruby128_calibration.hpp"

namespace terracut::ruby128 {

/// The maker's published table of the model RS-Ruby128 (docs/reference/sensors.md). Real units
/// differ from it by some hundredths of a degree, and a Ruby Plus altogether: for simulation, for
/// tests, and as the last resort where a user explicitly consents to it. `nominal` is set.
[[nodiscard]] Ruby128Calibration nominal_ruby128();

}  // namespace terracut::ruby128
