// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rt/error.hpp"

namespace terracut::cli {

/// That a command is named, that it has every option that is named, and that these have the values
/// they need. kInvalidArgument, with what was probably meant. Anything goes behind --help, and
/// behind --version before a command.
[[nodiscard]] Status check_names(const std::vector<std::string>& words);

/// The file of --config, before or behind the command; the last one counts. Empty: none.
[[nodiscard]] std::filesystem::path configuration_named_in(const std::vector<std::string>& words);

}  // namespace terracut::cli
