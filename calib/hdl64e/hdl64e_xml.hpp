// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "calib/hdl64e/hdl64e_calibration.hpp"

namespace terracut::hdl64e {

/// Reads the maker's calibration file, `db.xml` (Boost.Serialization XML, root
/// boost_serialization/DB; degrees and centimetres). Start-up only: allocates.
///
/// Two-point correction counts as present where distCorrectionX_ or distCorrectionY_ is not zero
/// and differs from distCorrection_. Missing intensity limits become 0 and 255, missing offsets 0.
/// Lasers with enabled_ 0 count as missing, and fewer than 64 lasers are an error. The result is
/// validated. Fails with kNotFound, kUnreadable, kMalformed or kUnsupported; the message names the
/// file, the laser and the field. Files above 4 MiB are refused.
[[nodiscard]] Expected<Hdl64eCalibration> read_hdl64e_xml(const std::filesystem::path& path);

/// Parses the content of a db.xml; `name` stands for the file in errors and becomes the origin.
[[nodiscard]] Expected<Hdl64eCalibration> parse_hdl64e_xml(std::span<const char> text,
                                                           const std::string& name);

}  // namespace terracut::hdl64e
