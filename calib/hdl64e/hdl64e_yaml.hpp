// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>

#include "calib/hdl64e/hdl64e_calibration.hpp"

namespace terracut::hdl64e {

/// Parses the YAML calibration format of the ROS velodyne drivers (`lasers:`, a list of maps in
/// block or inline style; radians and metres). Start-up only: allocates.
///
/// Two-point correction counts as present where dist_correction_x or dist_correction_y is not zero
/// and differs from dist_correction, unless two_pt_correction_available is false: some converters
/// left this key out of files that hold the values. Defaults for missing keys: min_intensity 0,
/// max_intensity 255, distance_resolution 0.002 m, offsets and focal values 0. The result is
/// validated. `name` stands for the file in errors and becomes the origin. Fails with kMalformed or
/// kUnsupported; the message names the laser or line and the field. Aliases and deep nesting are
/// refused.
[[nodiscard]] Expected<Hdl64eCalibration> parse_hdl64e_yaml(std::span<const char> text,
                                                            const std::string& name);

}  // namespace terracut::hdl64e
