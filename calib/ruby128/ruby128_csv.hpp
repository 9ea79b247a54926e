// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "calib/ruby128/ruby128_calibration.hpp"

namespace terracut::ruby128 {

/// Reads the maker's angle file (robosense::parse_angle_csv), of 128 channels. Start-up only:
/// allocates. The result is validated. Fails with kNotFound, kUnreadable, kMalformed or
/// kUnsupported; the message names the file, and the line if one line is at fault. Files above
/// 4 MiB are refused.
[[nodiscard]] Expected<Ruby128Calibration> read_ruby128_csv(const std::filesystem::path& path);

/// Parses the content of an `angle.csv`; `name` stands for the file in errors and becomes the
/// origin.
[[nodiscard]] Expected<Ruby128Calibration> parse_ruby128_csv(std::span<const char> text,
                                                             const std::string& name);

/// Returns the content of an `angle.csv`, in thousandths of a degree. `calibration` must pass
/// validate(). Parsing the text gives angles within half a thousandth, and the same fingerprint().
[[nodiscard]] std::string ruby128_csv_text(const Ruby128Calibration& calibration);

/// Writes ruby128_csv_text(), whole or not at all. Fails with kMalformed or kUnsupported if the
/// calibration fails validate(), kWriteFailed if the file cannot be written.
[[nodiscard]] Status write_ruby128_csv(const std::filesystem::path& path,
                                       const Ruby128Calibration& calibration);

}  // namespace terracut::ruby128
