// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "firmware_io/scan/kitti_scan.hpp"
#include "rt/error.hpp"

namespace terracut::cloud {

/// Checks that the points are metres from the sensor. kMalformed if most of them (finite, not null)
/// lie farther than a sensor sees. The message says how far, and the likely cause: millimetres,
/// centimetres, coordinates of a map, another layout of the file.
[[nodiscard]] Status check_reach(std::span<const scan::ScanPoint> points);

}  // namespace terracut::cloud
