// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "firmware_io/cloud/sensor_rows.hpp"

namespace terracut::cloud {

/// Returns why the clouds that rows were learnt from hardly come from one sensor in its own frame,
/// with the likely cause, for people; empty if nothing speaks against it. Labels are worse in such
/// a case, but need not be useless.
[[nodiscard]] std::string doubt_of(const SensorRows& rows);

}  // namespace terracut::cloud
