// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "rt/error.hpp"

namespace terracut::text {

/// Largest file read. Calibration and setup files are far smaller.
inline constexpr std::size_t kMaxFileBytes = std::size_t{4} << 20;

/// Returns the file's bytes. Fails with kNotFound, kUnreadable, or kUnsupported above
/// kMaxFileBytes; the message names the file and `what` it should have been ("an HDL-64E
/// calibration").
[[nodiscard]] Expected<std::string> read_bounded_file(const std::filesystem::path& path,
                                                      std::string_view what);

}  // namespace terracut::text
