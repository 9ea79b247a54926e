// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rt/error.hpp"

namespace terracut::cli {

/// Checks that a command is named, that it has every option given, and that these options have the
/// values they need. Fails with kInvalidArgument, suggesting a correction. Words after --help, and
/// after --version before a command, are not checked.
[[nodiscard]] Status check_names(const std::vector<std::string>& words);

/// Returns the file given by --config, before or after the command; the last one counts. Empty if
/// the option is not given.
[[nodiscard]] std::filesystem::path configuration_named_in(const std::vector<std::string>& words);

}  // namespace terracut::cli
