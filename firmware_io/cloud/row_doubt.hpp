// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "firmware_io/cloud/sensor_rows.hpp"

namespace terracut::cloud {

/// Returns, for people, why the clouds from which `rows` were learnt are probably not from one
/// sensor in its own frame, and the likely cause; empty if nothing suggests this. In such a case
/// labels are worse, but not always useless.
[[nodiscard]] std::string doubt_of(const SensorRows& rows);

}  // namespace terracut::cloud
