// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>

#include "calib/ouster/ouster_calibration.hpp"
#include "input.hpp"

namespace terracut::fuzz {

/// Returns a profile that the input chooses.
inline ouster::Profile any_profile(Input& input) {
  return ouster::kProfiles[input.next(1) % ouster::kProfiles.size()].profile;
}
/// Returns a number of rows that the input chooses.
inline int any_rows(Input& input) {
  return ouster::kRows[input.next(1) % ouster::kRows.size()];
}

}  // namespace terracut::fuzz
