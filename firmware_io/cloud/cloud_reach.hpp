// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "firmware_io/scan/kitti_scan.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// Checks that coordinates are metres from the sensor. Fails with kMalformed if most points (of
/// those finite and not null) are farther away than a sensor sees. The message says how far, and
/// the likely cause: millimetres, centimetres, map coordinates, another file layout.
[[nodiscard]] Status check_reach(std::span<const scan::ScanPoint> points);

}  // namespace terracut::cloud
