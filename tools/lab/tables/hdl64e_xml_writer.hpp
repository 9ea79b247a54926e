// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "rt/error.hpp"

namespace terracut::hdl64e {

/// Writes a `db.xml` (calib/hdl64e/hdl64e_xml.hpp) that this and other programs read, whole or not
/// at all. Reading it back gives exactly the same lengths, and exactly the same angles where they
/// are decimal fractions of a degree (others within one unit in the last place). Lasers without
/// two_point get X and Y corrections equal to far. Fails with kMalformed when the calibration fails
/// validate(), kWriteFailed when the file cannot be written.
[[nodiscard]] Status write_hdl64e_xml(const std::filesystem::path& path,
                                      const Hdl64eCalibration& calibration);

}  // namespace terracut::hdl64e
