// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>

#include "calib/hdl64e/hdl64e_calibration.hpp"

namespace terracut::hdl64e {

/// Reads an HDL-64E calibration file: the maker's db.xml (hdl64e_xml.hpp) or ROS YAML
/// (hdl64e_yaml.hpp), told apart by content, else by extension. Fails with kUnsupported for any
/// other file; the message lists the kinds that can be read, and names a RoboSense angle table
/// (csv) as such. Start-up only.
[[nodiscard]] Expected<Hdl64eCalibration> load_hdl64e_calibration(
    const std::filesystem::path& path);

}  // namespace terracut::hdl64e
