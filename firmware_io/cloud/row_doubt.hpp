// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "firmware_io/cloud/sensor_rows.hpp"

namespace terracut::cloud {

/// Why the clouds that rows were learnt from are hardly those of one sensor in its own frame, with
/// the likely cause, for people; empty where nothing speaks against it. Labels suffer where it is
/// so, but need not be useless.
[[nodiscard]] std::string doubt_of(const SensorRows& rows);

}  // namespace terracut::cloud
