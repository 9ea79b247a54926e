// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/ruby128/ruby128_calibration.hpp"

namespace terracut::ruby128 {

/// Returns the maker's table for the model RS-Ruby128 (docs/reference/sensors.md); `nominal` is
/// set. Real units differ from this table by hundredths of a degree, a Ruby Plus altogether. For
/// simulation, for tests, and as the last resort if the user explicitly consents.
[[nodiscard]] Ruby128Calibration nominal_ruby128();

}  // namespace terracut::ruby128
